// SPDX-License-Identifier: Apache-2.0
// This file starts photons of all lights of a scene. Lights are chosen by the flux that each sends.
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
  // `lights` has to outlive it. Distant lights and environments reach what lies in `bounds`, through the disc
  // that covers the sphere around it. Where `eye` lies within `bounds`, as many photons go through each of
  // some smaller and smaller discs around the eye. Light that enters near the eye counts most, and nobody
  // knows how near. Lights whose flux is 0 have no photons.
  Emission(const LightSampler& lights, const Bounds3f& bounds, Point3d eye);

  // Returns the luminous flux of all lights over 683 lm/W (∫ Φ ȳ dλ / ∫ ȳ dλ), through the least disc. It is
  // about the power that is sampled. 0: there is no light.
  double flux() const { return flux_; }
  // `place` has u, v of the point, and two numbers that choose the light, of which the second refines the
  // first. `way` has u, v of the direction, and the side.
  EmittedPhoton sample(const std::array<float, 4>& place, const std::array<float, 4>& way,
                       const SampledWavelengths& wavelengths) const;

 private:
  // `choice`, in [0,1), is what is left of the number that chose the light. The power is that of all photons
  // of the light.
  EmittedPhoton of_light(LightRef light, double choice, const std::array<float, 4>& place,
                         const std::array<float, 4>& way, const SampledWavelengths& wavelengths) const;
  // It is the place where a photon leaves a surface.
  struct Exit {
    Point3d p;
    Vector3d front;                    // normal, unit
    double area = 0;                   // over the density of points there, about uniform ones
    const AreaLight* light = nullptr;  // the surface's
    std::uint32_t triangle = 0;        // global id
    SampledSpectrum radiance;
  };
  // `choice` chooses one of the triangle's parts.
  Exit on_triangle(std::uint32_t triangle, double choice, const std::array<float, 4>& place,
                   const SampledWavelengths& wavelengths) const;
  Exit on_quadric(std::uint32_t quadric, const std::array<float, 4>& place,
                  const SampledWavelengths& wavelengths) const;
  static EmittedPhoton leave_surface(const Exit& exit, const std::array<float, 4>& way);
  EmittedPhoton of_emitter(std::uint32_t emitter, const std::array<float, 4>& way,
                           const SampledWavelengths& wavelengths) const;
  // Returns a photon of that irradiance across a direction, through one of the discs.
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
  // They are sums, from 0 to 1, of the shares of all lights by LightSampler's numbers.
  std::vector<double> cumulative_;
  GuideTable guide_;
};

}  // namespace vitrail
