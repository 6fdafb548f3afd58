// SPDX-License-Identifier: Apache-2.0
// Spectral path tracing through whatever sub-domains are resident: next-event estimation with multiple
// importance sampling (Veach 1997), Russian roulette, dispersion by the hero wavelength. A ray that needs an
// absent domain is put into the outbox; nothing about the picture depends on which ones were absent.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "film/film.h"
#include "tracer/intersect/intersector.h"
#include "tracer/panes/pane_walk.h"
#include "tracer/photons/photon_pass.h"
#include "tracer/prepared/render_scene.h"
#include "tracer/rays/ray_records.h"
#include "tracer/rays/ray_traffic.h"
#include "tracer/sampling/sampler.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

// Rays that have to go on in a domain that is not resident.
struct Outbox {
  struct Path {
    std::uint32_t domain;
    PathRecord record;
  };
  struct Shadow {
    std::uint32_t domain;
    ShadowRecord record;
  };
  struct Question {
    std::uint32_t domain;  // in whose cell the point lies
    Gather record;
  };
  std::vector<Path> paths;
  std::vector<Shadow> shadows;
  std::vector<Photon> photons;      // that landed
  std::vector<Question> questions;  // to the maps of other ranks

  std::size_t size() const { return paths.size() + shadows.size() + photons.size() + questions.size(); }
};

struct TraceCounters {
  std::uint64_t rays_camera = 0, rays_indirect = 0, rays_shadow = 0;
  std::uint64_t crossings = 0;  // domains entered after the first one of a ray
  // Rays alive: paths begun, and connections and shadow rays put into an outbox; the same when they end.
  std::uint64_t born = 0, died = 0;
  // Of photon mapping: sent from lights, questions answered, and photons found for them.
  std::uint64_t photons_emitted = 0, gathers = 0, photons_gathered = 0;
  // Connections to distant lights at faces where they leave glass, those that end there as the faces are not
  // quite parallel, and the widest wedge of these in 10⁻⁹ rad.
  std::uint64_t connections_in_glass = 0, connections_in_wedges = 0, widest_wedge_nrad = 0;

  // What is further from parallel than this is no pane, but a prism or a lens.
  static constexpr double widest_told_rad = 0.02;
  void count_leaving(bool leaves, double wedge_rad) {
    ++connections_in_glass;
    if (leaves || wedge_rad > widest_told_rad) return;
    ++connections_in_wedges;
    widest_wedge_nrad = std::max(widest_wedge_nrad, static_cast<std::uint64_t>(1e9 * wedge_rad));
  }
};
TraceCounters& operator+=(TraceCounters& a, const TraceCounters& b);

// Indexed by domain; null: not resident.
using ResidentViews = std::span<const DomainView* const>;

// Where a ray starts.
struct Departure {
  Point3d p;       // what it leaves
  Point3f origin;  // beside it
  std::uint32_t exclude = no_triangle;
  std::uint8_t inside = 0;  // state of Interiors
};

// What random numbers of a ray are for; those of different use are independent.
enum class RayRandom : std::uint64_t {
  flight,
  choice,
  scattering,
  light,
  layers,
  throughput,
  distance,
  coverage
};

class PathTracer {
 public:
  // All references outlive the tracer. One tracer a thread; the film is shared. `traffic`, if any, is told
  // where the rays go. `photons`, if any: of photon mapping.
  PathTracer(const RenderScene& scene, ResidentViews resident, Film& film, Outbox& outbox,
             TraceCounters& counters, RayTraffic* traffic = nullptr, const PhotonPass* photons = nullptr,
             const KernelFunctions& kernel = best_kernel());

  // Sample `sample` of the pixel (x, y) of the whole film, which lies in the crop.
  void trace_camera(int x, int y, std::uint32_t sample);
  // Goes on with a ray in `domain`, which is resident.
  void resume(const PathRecord& record, std::uint32_t domain);
  void resume(const ShadowRecord& record, std::uint32_t domain);

  // While photons fly: that one of the iteration's.
  void trace_photon(std::uint32_t number);
  // What the map has for a path that ended elsewhere.
  void answer(const Gather& question);

 private:
  struct Path;
  struct Shadow;

  CameraRay camera_ray(int x, int y, const Path& path) const;
  void run(Path& path, std::optional<std::uint32_t> at);
  bool find_hit(Path& path, std::optional<std::uint32_t> at);
  void intersect(Path& path, const RayConstants& constants, std::uint32_t domain);
  void count_visit(std::uint32_t domain) {
    if (traffic_) traffic_->visit(domain);
  }
  bool forward(const Path& path, std::uint32_t domain, bool resolved);
  void forward(const Shadow& shadow, std::uint32_t domain);

  // shading.cpp
  bool shade(Path& path);
  bool shade_surface(Path& path);
  bool misses(const Path& path, double opacity) const;
  inline bool end_at_surface(Path& path, const Interaction& at, const Surface& surface,
                             const MaterialKind& kind);
  const Material* material_at(Path& path, const Interaction& at, const Surface& surface,
                              const MaterialKind& kind, bool& goes_on) const;
  Scattering scattering_at(const Path& path, const Interaction& at, const Material& material) const;
  inline bool scatter_path(Path& path, const Interaction& at, const Surface& surface,
                           const MaterialKind& kind);
  bool scatter_in_medium(Path& path, Point3d p);
  float survival(const Path& path) const;
  bool go_on(Path& path, float u, bool specular, bool gathered = false) const;
  void scatter_straight(Path& path, const Interaction& at, const Surface& surface) const;
  bool passes_at_the_end(Path& path, const Interaction& at, const Surface& surface) const;
  SampledSpectrum straight_through(const Path& path, const Interaction& at, const Surface& surface) const;
  bool is_too_dark(const Path& path) const;
  bool is_there(const Path& path, const Surface& surface, Interaction& at) const;
  double opacity_at(const Surface& surface, const Interaction& at) const;
  void add_emission(const Path& path, const Interaction& at, std::uint32_t light);
  void add_environment(const Path& path);

  // glass.cpp
  bool scatter_dielectric(Path& path, const Interaction& at, const Surface& surface);
  double reflect_share(const Path& path, const SampledSpectrum& eta, double cosine, double outside,
                       SampledSpectrum& reflectance) const;
  void part_within(Path& path, const Interaction& at, const SampledSpectrum& eta, double cosine,
                   double outside) const;
  struct GlassFace;
  void reflect_at(Path& path, const Interaction& at, const Surface& surface, const GlassFace& face,
                  Vector3d& direction) const;
  void refract_at(Path& path, const Interaction& at, const Surface& surface, const GlassFace& face,
                  Vector3d& direction) const;
  void pass_into(Path& path, const Interaction& at, const GlassFace& face) const;
  bool passes_for_nothing(const Path& path, const Interaction& at) const;
  bool count_refraction(Path& path, float u, bool for_nothing) const;
  bool is_spent(const Path& path) const;
  bool sees_through(const Path& path, const Interaction& at) const;
  void count_straight(Path& path) const;
  bool leave_pane(Path& path) const;
  bool parts_aside(const Path& path, Point3d p, const SampledSpectrum& eta, double thickness,
                   double outside) const;
  double pixel_width(const Path& path, Point3d p) const;

  // photon_tracing.cpp
  void begin_photon(Path& path) const;
  bool shade_photon(Path& path);
  inline bool end_photon(Path& path, const Interaction& at, const Surface& surface, const MaterialKind& kind);
  inline bool scatter_photon(Path& path, const Interaction& at, const Surface& surface,
                             const MaterialKind& kind);
  EmittedPhoton emission_of(const Path& path) const;
  bool is_connected_to(const Path& path) const;
  std::optional<ParallelWay> parallel_way_of(const Path& path, const Interaction& at, const MetFace& face,
                                             double doubt_rad) const;
  void pass_sheet(Path& path) const;
  void pass_interface(Path& path, const Interaction& at, const Surface& surface, const MetFace& face,
                      Vector3d& direction) const;
  void turn_at_face(Path& path, const Interaction& at, const Surface& surface, const MetFace& face,
                    Vector3d& direction) const;
  void land(const Path& path, const Interaction& at);
  void gather(const Path& path, const Interaction& at, const Scattering& scattering, Vector3d out);
  bool flies() const { return photons_ && photons_->flying; }

  // sensors.cpp
  bool begin_at(Path& path, const Sensor& sensor);
  void seek(Path& path, Point3d from, Vector3d direction) const;
  bool seek_on(Path& path);
  bool leave_sensor(Path& path, const Sensor& sensor);

  // first_surface.cpp
  Transform bundle_to_camera(const Path& path) const;
  void record_first_surface(Path& path, const Interaction& at, const Surface& surface);
  std::array<double, 3> value_at(const Path& path, const Interaction& at, const Material& material,
                                 Layer layer) const;
  XYZ albedo_at(const Path& path, const Interaction& at, const Material& material) const;

  // departure.cpp
  Departure departure(const Path& path, const Interaction& at, const Surface& surface,
                      Vector3d direction) const;
  void depart(Path& path, const Departure& from, Vector3d direction) const;
  void continue_from(Path& path, const Interaction& at, const Surface& surface, Vector3d direction) const;
  void turn(Path& path, DirectionCode direction) const;
  // Null: what is there is a hole in a surface, which bounds nothing.
  void continue_straight(Path& path, const Interaction& at, const Surface* surface) const;
  void pass_straight(Path& path, const Interaction& at, const Surface* surface) const;
  Point3f offset_origin(const Interaction& at, Vector3d direction) const;
  Interaction interaction_at(const Path& path) const;
  const Surface& surface_at(const Path& path) const;
  Flight flight_of(const Path& path) const;
  const PreparedMedium* medium_of(const Path& path) const;
  static std::uint64_t hash_of_ray(const Path& path);
  static std::uint64_t stream_of(const Path& path, RayRandom use);
  double cone_unit() const;
  bool has_cone(const Path& path) const;
  double ray_angle(const Path& path) const;
  double cone_width(const Path& path, double distance) const;
  void widen_cone(Path& path, double distance) const;

  // connections.cpp
  std::uint32_t light_candidates(const Path& path, Point3d p, bool diffuse) const;
  void connect_surface(const Path& path, const Interaction& at, const Surface& surface,
                       const Scattering& scattering, Vector3d out, std::uint32_t candidates);
  void connect_medium(const Path& path, const Departure& from, double g, Vector3d out,
                      std::uint32_t candidates);
  void connect_sensor(const Path& path, const Departure& from, Vector3d normal, std::uint32_t candidates);
  template <class Scatter, class Depart>
  void connect(const Path& path, Point3d p, std::uint32_t count, const Scatter& scatter,
               const Depart& depart);
  void send_connection(const Path& path, const Departure& from, const LightSample& light,
                       const SampledSpectrum& radiance, bool walks);
  void send_shadow_ray(const Path& path, const Departure& from, const LightSample& light,
                       const SampledSpectrum& radiance);
  bool connect_onwards(Path& path);
  void reach_light(const Path& path);
  bool connect_at_surface(Path& path);
  // Of a surface: `gone` in an interior of higher priority, `open` as nothing scatters at it.
  enum class Presence : std::uint8_t { gone, open, whole };
  bool connect_past(Path& path, const Interaction& at, const Surface& surface, Presence presence);
  bool connects_through_hole(Path& path, const Interaction& at, const Surface& surface, bool opaque) const;
  bool connect_straight(Path& path, const Interaction& at, const Surface* surface);
  static void pack_connection(const Path& path, PathRecord& record);
  static void unpack_connection(const PathRecord& record, Path& path);

  // pane_connections.cpp
  enum class AtFace : std::uint8_t { ends, passes, turns };
  double face_doubt(const Path& path, const Interaction& at, const Surface& surface, Vector3d normal) const;
  static void fade(Path& path, const SampledSpectrum& transmitted);
  bool walks_on(Path& path) const;
  AtFace walk_at(Path& path, const FaceLight<SampledSpectrum>& face, bool parallel) const;
  FaceLight<SampledSpectrum> light_at(const Path& path, const Interaction& at,
                                      const DielectricMaterial& material, double outside,
                                      const SampledSpectrum& eta) const;
  bool walk_interface(Path& path, const Interaction& at, const Surface& surface) const;
  bool walk_sheet(Path& path, const Interaction& at, const Surface& surface) const;

  void trace_shadow(const Shadow& shadow, const SensorWeights* weights, std::optional<std::uint32_t> at);
  bool is_occluded(const Shadow& shadow, std::optional<std::uint32_t> at);
  void deposit(std::uint32_t pixel, std::uint32_t sample, const SensorWeights& weights,
               const SampledSpectrum& radiance);
  SensorWeights sensor_of(const std::array<float, 4>& camera, const SampledWavelengths& wavelengths) const;
  void find_wavelengths(Path& path) const;
  const Footprint* footprint_of(std::uint32_t pixel, std::uint32_t sample);
  SampleKey key_of(std::uint32_t pixel, std::uint32_t sample) const;
  std::array<float, 4> camera_numbers(const SampleKey& key) const;
  double time_of(const SampleKey& key) const;
  void begin(Path& path) const;
  std::array<float, 4> numbers_for_scattering(const Path& path, Wanted wanted = Wanted::four) const;
  std::array<float, 4> numbers_for_light(const Path& path) const;
  std::array<float, 2> numbers_for_far_lights(const Path& path) const;

  const RenderScene& scene_;
  const Manifest& manifest_;
  ResidentViews resident_;
  const KernelFunctions& kernel_;
  Film& film_;
  Outbox& outbox_;
  TraceCounters& counters_;
  RayTraffic* traffic_;
  const PhotonPass* photons_;
  struct {
    std::uint64_t of = ~std::uint64_t{0};  // pixel and sample
    Footprint footprint;
  } landed_;  // the last one
};

}  // namespace vitrail
