// SPDX-License-Identifier: Apache-2.0
// A path while it is being traced, unpacked from its record, and a hit made ready for shading.
#pragma once

#include "tracer/path_tracer.h"

namespace vitrail {

struct PathTracer::Path {
  std::uint32_t pixel = 0, sample = 0;
  std::uint32_t depth = 0;
  std::uint8_t flags = 0;
  float pdf = 0;        // of the last scattering, solid angle, already rounded; 0: specular or camera
  FaceCode entered_by;  // in a pane: the face it came in through
  SampledSpectrum throughput;
  DirectionCode direction;
  Ray ray;
  RayConstants constants;
  Hit hit;
  std::uint32_t hit_domain = 0;
  SampledWavelengths wavelengths;
  SensorWeights sensor;

  bool is(PathFlags flag) const { return flags & flag; }
  void set(PathFlags flag) { flags = static_cast<std::uint8_t>(flags | flag); }
  void clear(PathFlags flag) { flags = static_cast<std::uint8_t>(flags & ~flag); }
  // Ends the secondary wavelengths: their ways part from the hero's here.
  void disperse() {
    clear(path_in_pane);
    if (is(path_dispersed)) return;
    set(path_dispersed);
    throughput = {{throughput[0] * hero_count, 0, 0, 0}};
  }
};

struct PathTracer::Interaction {
  Point3d p;
  Vector3d out;        // unit, back along the ray
  Vector3d geometric;  // unit normal of the front side
  Vector3d shading;    // unit, on the same side as `geometric`
  std::uint32_t triangle = no_triangle;
  bool front = false;  // the ray came from the front side
};

}  // namespace vitrail
