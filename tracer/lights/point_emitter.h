// SPDX-License-Identifier: Apache-2.0
// Lights that shine from one point: point, spot, projection, goniometric.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>

#include "scene/records/light.h"
#include "tracer/lights/light_image.h"
#include "tracer/lights/light_tree.h"
#include "tracer/lights/sphere_map.h"
#include "tracer/sampling/flat_spectrum.h"
#include "tracer/textures/textures.h"

namespace vitrail {

// Everything that a light's intensity needs, prepared.
struct PointEmitter {
  struct Everywhere {};
  struct Spot {
    SpotLight::Falloff falloff = SpotLight::Falloff::smoothstep;
    double cos_beam = 1, cos_cutoff = 0, cutoff_rad = 0, beam_rad = 0;
    double frame = 1;  // half width of the texture's square at z = 1; 0: no texture
    std::optional<Id<Texture>> texture;
    double tightness = 0;  // a power of the cosine
  };
  // A rectangle at z = 1 of half widths `half`.
  struct Projection {
    SpectrumParameter image;
    Point2d half{1, 1};
    bool irradiance = false;
  };
  struct Goniometric {
    std::shared_ptr<const LightImage> image;
    bool latitude_longitude = false;
    SphereProjection projection() const {
      return latitude_longitude ? SphereProjection::latitude_longitude : SphereProjection::equal_area;
    }
  };

  Point3d position;
  Transform world_to_light;  // its 3×3 block
  bool is_rigid = true;      // that turns, mirrors and scales alike
  bool casts_shadows = true;
  Spectrum intensity;  // multiplies all that follows
  std::optional<Fading> fading{};
  float factor = 1;  // beside it
  std::variant<Everywhere, Spot, Projection, Goniometric> shape;
  LightBounds bounds;       // power: luminous flux
  std::uint32_t light = 0;  // index into LightScene::lights
};

// What lanes read of one that shines to all sides, or as a spot without a texture.
struct PlainEmitter {
  Point3d position;
  Vector3d to_local[3];     // rows of its world_to_light
  PointEmitter::Spot spot;  // to all sides: one whose beam is everything
  bool fades = false;
  double fade_distance = 1, fade_power = 0;  // 0: it does not weaken at all
  FlatSpectrum intensity;
};
// Empty: it is another. `emitter` outlives it.
std::optional<PlainEmitter> plain_emitter(const PointEmitter& emitter);

// `image`: of a goniometric light. `aspect`: width over height of a projection's image. `records`: of the
// textures.
PointEmitter make_emitter(const PointLight& light);
PointEmitter make_emitter(const SpotLight& light, const Textures* textures = nullptr,
                          std::span<const Texture> records = {});
PointEmitter make_emitter(const ProjectionLight& light, double aspect, const Textures* textures,
                          std::span<const Texture> records = {});
PointEmitter make_emitter(const GoniometricLight& light, std::shared_ptr<const LightImage> image);

// Radiant intensity, W·sr⁻¹·nm⁻¹. `direction` unit, from the light, in the world. `textures` may be null
// where no emitter has one.
SampledSpectrum intensity(const PointEmitter& emitter, Vector3d direction, const Textures* textures,
                          const SampledWavelengths& wavelengths);

// The irradiance across the direction at a distance, over the intensity: 1/d², or as the light fades.
double weakened(const PointEmitter& emitter, double distance);

// Fits the bounds of a light that fades to a scene whose farthest point is that far from it: its power
// becomes that of one that weakens as 1/d² beyond `near`, and sends nowhere less than the light.
void bound_fading(PointEmitter& emitter, double farthest);

}  // namespace vitrail
