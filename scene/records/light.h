// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "scene/records/boxed.h"
#include "scene/records/texture.h"

namespace vitrail {

// A surface emits radiance, W·m⁻²·sr⁻¹·nm⁻¹, from its front side or from both.
struct AreaLight {
  SpectrumParameter radiance;
  float scale = 1;  // of a texture
  bool two_sided = false;
  bool directional = false;  // only along the normal (Mitsuba's directionalarea)
  // It is true for a lamp, which connections go to and photons leave from. Else it is a glow, as POV-Ray's
  // `ambient` and `emission`: seen by the camera, in mirrors and through glass, and found by the scattered
  // rays of `--integrator path` alone. For `direct` it lights nothing. It costs nothing but where it is seen.
  bool sampled = true;
  Origin origin;
  std::string name = {};  // "" where the file gives none
  bool operator==(const AreaLight&) const = default;
};

// It says how a lamp weakens with the distance d, as a `light_source` of POV-Ray does. The irradiance across
// the direction to it is intensity · 2/(1 + (d/fade_distance)^fade_power), and intensity itself where either
// is 0, as POV-Ray has it by default. The unit of the intensity is then W·m⁻²·nm⁻¹. POV-Ray's colour c, which
// shows c·ρ·cos θ on a diffuse surface, is the intensity π·c.
struct Fading {
  float fade_distance = 0, fade_power = 0;
  bool operator==(const Fading&) const = default;
};

// Its radiant intensity, W·sr⁻¹·nm⁻¹, is equal in all directions.
struct PointLight {
  Point3d position;
  Spectrum intensity;
  std::optional<Fading> fading{};  // none: as 1/d²
  bool operator==(const PointLight&) const = default;
};

// It has `intensity` on its axis, local +z, and within `beam_deg` of it; from there it falls to 0 at
// `cutoff_deg`.
struct SpotLight {
  // They are smoothstep of the cosine (pbrt-v4), its fourth power (pbrt-v3), and linear in the angle
  // (Mitsuba).
  enum class Falloff : std::uint8_t { smoothstep, quartic, linear };
  Boxed<Transform> light_to_world;
  Spectrum intensity;
  float beam_deg = 25, cutoff_deg = 30;
  Falloff falloff = Falloff::smoothstep;
  std::optional<Id<Texture>> texture;  // multiplies, over the square frame of the cutoff
  std::optional<Fading> fading{};      // none: as 1/d²
  // It is an exponent: cos^tightness of the angle to the axis multiplies the intensity. POV-Ray's `radius`
  // and `falloff` are beam_deg and cutoff_deg of a smoothstep.
  float tightness = 0;
  bool operator==(const SpotLight&) const = default;
};

// It throws an image from a point along local +z, times `scale`: the intensity in each direction (pbrt), or
// the irradiance on a plane across the axis at distance 1 (Mitsuba), which is less by cos³. `fov_deg` is
// measured on the image's shorter axis (pbrt) or its width (Mitsuba).
struct ProjectionLight {
  Boxed<Transform> light_to_world;
  Boxed<SpectrumParameter> image;
  Spectrum scale = ConstantSpectrum{1};
  float fov_deg = 90;
  bool irradiance = false;     // Mitsuba's measures
  std::optional<float> power;  // luminous flux that the light is normalised to
  bool operator==(const ProjectionLight&) const = default;
};

// It is a point light whose intensity in every direction is `intensity` times an image of it.
struct GoniometricLight {
  Boxed<Transform> light_to_world;
  Boxed<Spectrum> intensity;
  std::string filename;  // absolute; equal-area octahedral (pbrt-v4) or latitude-longitude (v3)
  bool latitude_longitude = false;
  std::optional<float> power;
  Encoding encoding = Encoding::automatic;  // of the image
  ImageNumber number = ImageNumber::mean;
  bool operator==(const GoniometricLight&) const = default;
};

// It gives irradiance on a plane across `direction` (unit, the way the light travels), W·m⁻²·nm⁻¹.
struct DistantLight {
  Vector3d direction;
  Spectrum irradiance;
  bool operator==(const DistantLight&) const = default;
};

// It shines with constant radiance from everywhere around the scene.
struct InfiniteLight {
  Spectrum radiance;
  bool operator==(const InfiniteLight&) const = default;
};

// Its radiance comes from an image around the scene, times `scale`. The direction d in the light's frame
// meets the image at
// - equal_area: the square octahedral map of Clarberg 2008, +z up (pbrt-v4),
// - latitude_longitude: u = atan2(y,x)/2π (+1), v = acos(z)/π from the top, +z up (pbrt-v3).
struct EnvironmentLight {
  enum class Projection : std::uint8_t { equal_area, latitude_longitude };
  std::string filename;  // absolute
  Boxed<Transform> light_to_world;
  Projection projection = Projection::equal_area;
  Boxed<Spectrum> scale = Spectrum{ConstantSpectrum{1}};
  std::optional<float> illuminance;                     // of an upward plane, lx; sets the scale of the image
  Boxed<std::optional<std::array<Point3d, 4>>> portal;  // light enters the scene only through this rectangle
  Encoding encoding = Encoding::automatic;              // of the image
  Primaries primaries = Primaries::file;
  bool operator==(const EnvironmentLight&) const = default;
};

// It tells how bright a sky is in one direction relative to another, by the angles θ from the zenith and γ
// from the sun: (1 + a·e^(b/cos θ)) · (base + c·e^(d·γ) + e·cos²γ). In ISO 15469 base is 1 − c·e^(d·π/2), for
// Perez 1. Its spectrum is the CIE's daylight of the light's temperature.
struct SkyDistribution {
  double a = 0, b = -1, base = 1, c = 0, d = -1, e = 0;
  double diffuse_lx = 0;  // on a horizontal plane, where the light's sky_scale is 1
  bool operator==(const SkyDistribution&) const = default;
};

// It is the sky and the sun's disc, by the model of scene/daylight/sky_model.h. In the light's frame +z is
// the zenith. Nothing shines with the sun below the horizon; with it above, the ground alone shines from
// below.
struct SkyLight {
  Boxed<Transform> light_to_world;
  Vector3d to_sun{0, 0, 1};                                   // unit, in the light's frame
  float turbidity = 3;                                        // 1 … 10, held beyond
  Boxed<Spectrum> albedo = Spectrum{ConstantSpectrum{0.3f}};  // of the ground, 0 … 1
  float sky_scale = 1, sun_scale = 1;                         // 0: without it
  float sun_diameter_deg = 0.5358f;                           // another one spreads the same irradiance
  bool limb_darkening = true;                                 // else the disc is uniform
  Boxed<std::optional<SkyDistribution>> distribution;  // of the sky, in place of a clear one's; the sun stays
  float color_temperature_k = 0;                       // correlated, of a distribution's sky; 0: D65
  // It is the share of the sun's and the sky's light on a horizontal plane that the ground reflects. It is
  // the same at all wavelengths and to all sides. The ground is uniform, without shadows, and as far as the
  // sky.
  float ground = 0;
  bool operator==(const SkyLight&) const = default;
};

using LightVariant = std::variant<PointLight, SpotLight, ProjectionLight, GoniometricLight, DistantLight,
                                  InfiniteLight, EnvironmentLight, SkyLight>;
// It is copied, moved, destroyed and compared in scene/records/special_members.cpp alone: in every file that
// handles a scene, that took up to two thirds of its compiling.
struct LightModel : LightVariant {
  using LightVariant::LightVariant;
  LightModel();
  LightModel(const LightModel&);
  LightModel(LightModel&&) noexcept;
  LightModel& operator=(const LightModel&);
  LightModel& operator=(LightModel&&) noexcept;
  ~LightModel();
  bool operator==(const LightModel&) const;
};

// It is a light that is no surface of the scene.
struct Light {
  LightModel model;
  Origin origin;
  // It is looked at for point and spot lights. If it is false, nothing stands in the way of the light that
  // they send straight to a surface. That light shows no highlight (FinishMaterial), as of POV-Ray's
  // `shadowless` lamps.
  bool casts_shadows = true;
  std::string name = {};  // "" where the file gives none
  bool operator==(const Light&) const = default;
};

}  // namespace vitrail
