// SPDX-License-Identifier: Apache-2.0
// These stages of a wave take several paths at a time, one a lane: what scatters there is of one kind for all
// of them. Each gives every path the bits that `shade` gives it. They are compiled for each instruction set
// from one text, lane_stages.inl.
#pragma once

#include <cstdint>

#include "tracer/intersect/intersector.h"
#include "tracer/lanes/domain_tables.h"
#include "tracer/prepared/lane_scene.h"
#include "tracer/transport/scatterer.h"
#include "tracer/transport/shadow_ray.h"
#include "tracer/view/camera_rays.h"
#include "tracer/view/pixel_filter.h"

namespace vitrail {

// It holds what the stages read of an Interaction that they cannot make themselves. The hit is within an
// instance, or of a quadric, or of a surface whose material is chosen or whose normal is turned. A point in a
// medium has p alone.
struct PlacedHit {
  Point3d p;
  Vector3d geometric, shading, dpdu;
  double rounding;
  Point2d uv;
};

// It is what the stages work on. Paths and what is kept of each are at their places in a wave.
struct LaneWork {
  Tracing& tracing;
  const LaneScene& scene;
  CameraPath* paths;
  const std::uint32_t* surface;        // of a path's hit, in Manifest::surfaces
  const std::uint32_t* material;       // that it has met there, in LaneScene::materials
  const LaneBsdf* bsdfs;               // of those whose surface has one
  const LaneCoating* coatings;         // of those whose material is coated
  const PlacedHit* placed;             // of hits that are in a list of such
  const lanes::DomainTables* domains;  // of hits' domains
  float roulette_worth;                // what a path is worth going on for; 0: no roulette
  bool direct_only;                    // as RenderSettings
  bool ends_lit;                       // as shading.h
  bool groups_lights;                  // the film keeps groups of lights
  double rounding_of_doubles;          // as of offset_origin

  // These are the results: shadow rays behind those that are there, and the places of paths that go on.
  ShadowRays& shadows;
  std::uint32_t* next;
  std::size_t next_count = 0;
  std::uint64_t rays_shadow = 0;
};

// They are places of paths that have come to surfaces of one kind, and are not to end there.
struct LaneList {
  const std::uint32_t* places;
  std::size_t count;
  bool is_placed;            // all have a PlacedHit, or none has
  std::uint32_t candidates;  // for a light, of each
};

// They are paths that begin, whose samples are set.
struct NewPaths {
  const Tracing& tracing;
  CameraPath* paths;
  const std::uint32_t* places;
  std::size_t count;
  const CameraSampler::LinearRays* rays;  // null: not of such a camera
  double width;                           // of the whole picture, in pixels
  bool is_even;                           // as FilterSampler::even_radius
  Point2d radius;
};

struct LaneStages {
  // Gives paths their numbers for the camera, their wavelengths and what the sensor makes of them; a linear
  // camera also gives their rays.
  void (*begin)(const NewPaths& work);

  // Adds the light that paths see which leave the scene: not within a pane, with no medium there and no disc
  // of a sun.
  void (*leave_scene)(LaneWork& work, const LaneList& list);

  // Scatters at points of media.
  void (*scatter_in_media)(LaneWork& work, const LaneList& list);

  // There is a stage for each kind but `none`.
  void (*stage[lane_kinds])(LaneWork& work, const LaneList& list);
};

// Returns the stages for the instruction set of a kernel that runs here.
const LaneStages& lane_stages(Kernel kernel);

extern const LaneStages portable_stages;
#if defined(__x86_64__)
extern const LaneStages avx2_stages;
extern const LaneStages avx512_stages;
#endif

// The stages leave these to one path at a time.
namespace lane_by_lane {

// It is sample_light for a path, with the numbers of a candidate. It returns false where nothing arrives.
bool sample(const LaneWork& work, const CameraPath& path, Point3d p, const float (&u)[4], LightSample& light);
// It is the light of the tree that a path has chosen: its probability, and what is left of the number that
// chose it. `draw` does the same as `sample` for it.
struct ChosenLight {
  std::uint32_t slot;
  double rest, probability;
};
bool draw(const LaneWork& work, const CameraPath& path, Point3d p, const float (&u)[4],
          const ChosenLight& chosen, LightSample& light);
// They are LightSampler::choice_of and light_of, and the face of a triangle.
std::size_t choice_of(const LightSampler& lights, double u);
LightRef light_of(const LightSampler& lights, std::uint32_t slot);
LightSampler::Face face_of(const LightSampler::Slot& triangle);
// Returns the group of a light, as GroupedLights does.
std::uint8_t group_of(const LaneWork& work, LightRef light);
FilterSample filter_sample(const Tracing& tracing, float u, float v);
// Evaluates a spectrum that is an `other`.
void evaluate(const FlatSpectrum& spectrum, const CameraPath& path, float (&value)[4]);
// Deposits radiance times throughput, of all that is around the scene.
void deposit_surroundings(const LaneWork& work, const CameraPath& path, const SampledSpectrum& radiance);
// It says where a ray leaves a surface; `front_side`: it leaves on the front.
struct SurfaceSide {
  std::uint32_t place;
  bool from_front, front_side;
};
// Sends a path's light sample by whatever ray it takes, where light may pass something.
using Leaving = Departure;
void send(LaneWork& work, const CameraPath& path, const Leaving& from, const LightSample& light,
          const SampledSpectrum& radiance);
// A StraightConnection goes straight to a light.
struct StraightConnection {
  Leaving from;
  Vector3f direction;
  DirectionCode code;    // the direction's
  std::uint64_t random;  // hash of the ray
  double end, slope;     // as Connection
  LightRef light;
};
void begin_connection(LaneWork& work, const CameraPath& path, const StraightConnection& way,
                      const SampledSpectrum& throughput);
Vector3d sample_phase(double g, Vector3d out, float u, float v);
// Returns the state of Interiors there.
std::uint8_t inside(const LaneWork& work, const CameraPath& path, const SurfaceSide& side);
// Aims a shadow ray to a quadric.
void aim(const CameraPath& path, Point3d p, Point3f origin, const LightSample& light, ShadowRay& shadow);
// It gives the numbers of numbers_for_scattering, and those for lights, of a path that has passed something
// for nothing.
void hash_numbers(const CameraPath& path, RayRandom use, float (&numbers)[4]);
// It is a sheet behind which a path goes straight on.
struct SheetHit {
  std::uint32_t place;
  Point3d p;
  Vector3d geometric;
  double rounding;
  bool front;
};
void pass_sheet(LaneWork& work, CameraPath& path, const SheetHit& hit, const SampledSpectrum& throughput);
// It is vitrail::polarization_at.
double polarization_at(const CameraPath& path, Vector3d normal);
// It is a face of glass of one index.
struct CrossedFace {
  Vector3d normal;  // on the path's side
  bool front, reflected;
  double q;  // Q/I behind it,
  float u;   // and what rounds it
};
// Records what is known of the face then.
void cross_face(CameraPath& path, const CrossedFace& face);

}  // namespace lane_by_lane

}  // namespace vitrail
