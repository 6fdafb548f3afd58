// SPDX-License-Identifier: Apache-2.0
// A path while it is being traced, unpacked from its record.
#pragma once

#include <array>
#include <cmath>

#include "tracer/paths/path_tracer.h"
#include "tracer/surfaces/interaction.h"

namespace vitrail {

// A shadow ray while it is being traced, its values rounded as those of its record.
struct PathTracer::Shadow {
  Ray ray;
  DirectionCode direction;  // the ray's
  float tmax = 0;
  SampledSpectrum radiance;
  std::uint32_t pixel = 0, sample = 0;
  double time_s = 0;  // its path's
};

// Of Path::depth where only direct light is asked for, or photons bring the rest: the path has scattered, and
// goes straight on at most.
inline constexpr std::uint32_t scattered_once = 1u << 16;

// What a ray has come to once its hit is known. A connection to a light at a finite distance is given its end
// as the distance of its hit and no triangle, one to a light infinitely far has no end.
enum class Met { surface, light, nothing };

struct PathTracer::Path {
  std::uint32_t pixel = 0, sample = 0;  // of a photon: its number, and PhotonHistory
  SampleKey key;                        // of these
  std::uint64_t seed = 0;               // sample_seed of it
  std::uint32_t depth = 0;
  std::uint8_t flags = 0;
  float pdf = 0;            // of the last scattering, as density_beside says; 0: specular or camera
  FaceCode entered_by;      // in a pane: the face it came in through,
  bool parts = false;       // whether its wavelengths part but at a face parallel to that,
  bool owes = false;        // and whether it counts as scattered there then
  std::uint32_t aim = 0;    // of a connection: bits of a RefractedAim or a StraightAim
  std::uint32_t walk = 0;   // with a RefractedAim: bits of a PaneWalk
  double travelled = 0;     // since the last scattering, straight through surfaces; of a straight connection
                            // what is left, in lengths of its direction; already rounded
  std::uint8_t inside = 0;  // state of Interiors
  std::uint8_t cone = 0;    // cone_code of its width where it starts; 0 of connections
  SampledSpectrum throughput;
  DirectionCode direction;
  Ray ray;
  std::uint64_t random = 0;  // a hash of the ray
  Hit hit;
  std::uint32_t hit_domain = 0;
  std::array<float, 4> camera{};  // its sample's numbers for the camera; wavelengths follow from them
  double time_s = 0;              // when its sample sees the scene, where anything moves
  bool has_wavelengths = false;   // only what sees anything needs them
  SampledWavelengths wavelengths;
  mutable LastLamp lamp;
  SensorWeights sensor;

  Met met() const {
    if (hit.triangle != no_triangle) return Met::surface;
    return std::isinf(hit.t) ? Met::nothing : Met::light;
  }
  bool is(PathFlags flag) const { return flags & flag; }
  void set(PathFlags flag) { flags = static_cast<std::uint8_t>(flags | flag); }
  void clear(PathFlags flag) { flags = static_cast<std::uint8_t>(flags & ~flag); }
  std::size_t active_wavelengths() const { return is(path_dispersed) ? 1 : hero_count; }
  // About the point of the last scattering.
  Point3d scattered_from() const {
    return cast<double>(ray.origin) - cast<double>(ray.direction) * travelled;
  }
  // Ends the secondary wavelengths: their ways part from the hero's here.
  void disperse() {
    if (is(path_dispersed)) return;
    set(path_dispersed);
    throughput = {{throughput[0] * hero_count, 0, 0, 0}};
  }
};

}  // namespace vitrail
