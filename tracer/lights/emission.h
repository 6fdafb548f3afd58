// SPDX-License-Identifier: Apache-2.0
// Where light sets out: photons of all lights of a scene, chosen by the flux that each sends.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracer/lights/emitter_directions.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/sampling/guide_table.h"

namespace vitrail {

struct EmittedPhoton {
  Point3d p;
  Vector3d direction;                    // unit, the way it travels
  Vector3d normal{};                     // of the surface it leaves, unit, on that side; 0: it leaves none
  std::uint32_t triangle = ~0u;          // global id of that surface
  SampledSpectrum power;                 // W·nm⁻¹, over the density of all that was chosen
  bool is_distant = false;               // of a light that has one direction
  const PointEmitter* fading = nullptr;  // of a light that fades as POV-Ray's
};

class Emission {
 public:
  // `lights` outlives it. Distant lights and environments reach what lies in `bounds`, through the disc that
  // covers the sphere around it, and, where `eye` lies within, through smaller and smaller ones around that,
  // alike many through each: light that enters near the eye counts most, how near nobody knows. Lights whose
  // flux is 0 have no photons.
  Emission(const LightSampler& lights, const Bounds3f& bounds, Point3d eye);

  // Luminous flux of all lights over 683 lm/W (∫ Φ ȳ dλ / ∫ ȳ dλ), through the least disc: about the power of
  // what is sampled. 0: no light.
  double flux() const { return flux_; }
  // place: u, v of the point, which light (two numbers, the second refines); way: u, v of the direction,
  // side.
  EmittedPhoton sample(const std::array<float, 4>& place, const std::array<float, 4>& way,
                       const SampledWavelengths& wavelengths) const;

 private:
  // `choice`: in [0,1), what is left of the number that chose the light. The power is that of all its
  // photons.
  EmittedPhoton of_light(LightRef light, double choice, const std::array<float, 4>& place,
                         const std::array<float, 4>& way, const SampledWavelengths& wavelengths) const;
  // Where photons leave a surface.
  struct Exit {
    Point3d p;
    Vector3d front;                    // normal, unit
    double area = 0;                   // over the density of points there, about uniform ones
    const AreaLight* light = nullptr;  // the surface's
    std::uint32_t triangle = 0;        // global id
    SampledSpectrum radiance;
  };
  // `choice`: of one of its parts.
  Exit on_triangle(std::uint32_t triangle, double choice, const std::array<float, 4>& place,
                   const SampledWavelengths& wavelengths) const;
  Exit on_quadric(std::uint32_t quadric, const std::array<float, 4>& place,
                  const SampledWavelengths& wavelengths) const;
  static EmittedPhoton leave_surface(const Exit& exit, const std::array<float, 4>& way);
  EmittedPhoton of_emitter(std::uint32_t emitter, const std::array<float, 4>& way,
                           const SampledWavelengths& wavelengths) const;
  // Of irradiance across a direction, through one of the discs.
  EmittedPhoton through_disc(Vector3d direction, const SampledSpectrum& irradiance, float u, float v,
                             float choice) const;

  struct Sphere {
    Point3d centre;
    double radius = 0;
  };
  const LightSampler& lights_;
  std::vector<EmitterDirections> directions_;  // of the emitters' shapes
  std::vector<std::uint32_t> directions_of_;   // of each emitter, which
  std::vector<Sphere> spheres_;                // that discs cover, the scene's first
  double flux_ = 0;
  // Of all lights by LightSampler's numbers: sums of their shares, from 0 to 1.
  std::vector<double> cumulative_;
  GuideTable guide_;
};

}  // namespace vitrail
