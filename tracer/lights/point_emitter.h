// SPDX-License-Identifier: Apache-2.0
// These are lights that shine from one point: point, spot, projection, goniometric.
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

// A light that shines to all sides is a spot whose beam is everything.
struct SpotShape {
  SpotLight::Falloff falloff = SpotLight::Falloff::smoothstep;
  double cos_beam = 1, cos_cutoff = 0, cutoff_rad = 0, beam_rad = 0;
  double frame = 1;  // half width of the texture's square at z = 1; 0: no texture
  std::optional<Id<Texture>> texture;
  double tightness = 0;  // a power of the cosine
};

// It is a rectangle at z = 1 of half widths `half`.
struct ProjectionShape {
  SpectrumParameter image;
  Point2d half{1, 1};
  bool irradiance = false;
};

struct GoniometricShape {
  std::shared_ptr<const LightImage> image;
  bool latitude_longitude = false;
  SphereProjection projection() const {
    return latitude_longitude ? SphereProjection::latitude_longitude : SphereProjection::equal_area;
  }
};

// It says how light leaves a point, whatever its place and colour. All point lights share one.
struct EmitterShape {
  std::variant<SpotShape, ProjectionShape, GoniometricShape> kind;
  Transform world_to_light;                 // its 3×3 block
  bool is_rigid = true;                     // that turns, mirrors and scales alike
  float factor = 1;                         // of the intensity
  Vector3d axis{0, 0, 1};                   // of LightBounds, in the world
  double theta_o_rad = 0, theta_e_rad = 0;  // of LightBounds

  // Returns the spot where it has no texture: lanes know this shape. Null: it is another shape.
  const SpotShape* plain() const {
    const auto* spot = std::get_if<SpotShape>(&kind);
    return spot && !spot->texture ? spot : nullptr;
  }
};

// It is a light, prepared. It refers to the light's record; with many lights, little is kept for each.
struct PointEmitter {
  Point3d position;
  const Spectrum* intensity = nullptr;  // multiplies what its shape says
  const Fading* fading = nullptr;       // null: as 1/d²
  std::shared_ptr<const EmitterShape> shape;
  double flux = 0;          // luminous, of one that weakens as 1/d²
  std::uint32_t light = 0;  // index into LightScene::lights
  bool casts_shadows = true;
};

// `image` is that of a goniometric light. `aspect` is width over height of a projection's image. `records`
// are those of the textures. The light has to outlive its emitter.
PointEmitter make_emitter(const PointLight& light);
PointEmitter make_emitter(const SpotLight& light, const Textures* textures = nullptr,
                          std::span<const Texture> records = {});
PointEmitter make_emitter(const ProjectionLight& light, double aspect, const Textures* textures,
                          std::span<const Texture> records = {});
PointEmitter make_emitter(const GoniometricLight& light, std::shared_ptr<const LightImage> image);

// Returns the radiant intensity, W·sr⁻¹·nm⁻¹. `direction` is unit, from the light, in the world. `textures`
// may be null where no emitter has one.
SampledSpectrum intensity(const PointEmitter& emitter, Vector3d direction, const Textures* textures,
                          const SampledWavelengths& wavelengths);

// Returns the irradiance across the direction at a distance, over the intensity: 1/d², or as the light fades.
double weakened(const PointEmitter& emitter, double distance);

// Returns what the tree has to know; power: luminous flux. `farthest` is the distance of the scene's farthest
// point. A light that fades gets the power of one that weakens as 1/d² beyond `near`, and that sends nowhere
// less than it does.
LightBounds bounds_of(const PointEmitter& emitter, double farthest);

}  // namespace vitrail
