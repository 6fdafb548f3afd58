// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/pbrt/read/image_numbers.h"
#include "importers/pbrt/read/sphere_images.h"
#include "importers/reading/given_sky.h"
#include "importers/reading/suggestion.h"
#include "scene/geometry/frame.h"
#include "scene/geometry/pi.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

struct LightMaker {
  const std::string& kind;
  ParameterSet& parameters;
  const Transform& ctm;
  const Scope& scope;

  // The emission under `name`, white of luminance 1 where it is not given, times `scale` and `factor`.
  Spectrum emission(std::string_view name, double factor = 1) const {
    const Parameter* parameter = parameters.find_spectrum(name);
    const Parameter* scale = parameters.find_spectrum("scale");  // in v3 a spectrum
    const bool plain = !scale || scale->type == ParameterType::number;
    const double total = scale && plain ? factor * parameters.number("scale", 1) : factor;
    const Spectrum spectrum = parameter ? read_emission(*parameter, total, scope)
                                        : Spectrum{emission_from_rgb({total, total, total})};
    return plain ? spectrum : product(spectrum, read_unbounded(*scale, scope));
  }
  // What an image is multiplied by: `scale` and the colour of the light's spectrum, 1 where there is none.
  // The image is lit by D65 already: v3 multiplies rgb.
  Spectrum factor_of_image(std::string_view name) const {
    const Parameter *color = parameters.find_spectrum(name), *scale = parameters.find_spectrum("scale");
    Spectrum factor = scale ? read_unbounded(*scale, scope) : Spectrum{ConstantSpectrum{1}};
    if (!color) return factor;
    if (color->type == ParameterType::rgb || color->type == ParameterType::xyz)
      return product(read_unbounded(*color, scope), factor);
    const RGB c = xyz_to_srgb(to_xyz(resolved(read_emission(*color, 1, scope))));
    return product(unbounded_from_rgb({std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)}), factor);
  }
  // v3 decodes the images of textures alone.
  Encoding encoding_of_image() const {
    return scope.context.version == Version::v3 ? Encoding::linear : Encoding::automatic;
  }
  const Parameter* image() const {
    const Parameter* filename = parameters.find("filename", {ParameterType::text});
    return filename ? filename : parameters.find("mapname", {ParameterType::text});
  }
  std::optional<float> optional_number(std::string_view name) const {
    const double value = parameters.number(name, -1);
    return value > 0 ? std::optional(static_cast<float>(value)) : std::nullopt;
  }
  void approximated(const std::string& how) const {
    scope.context.report.approximated(fmt::format("light \"{}\": {}", kind, how), parameters.place());
  }
};

// Where the luminous `power` is given, what it divides by; else 1.
double power_factor(const LightMaker& m, double steradians) {
  const double power = m.parameters.number("power", -1);
  return power > 0 ? power / steradians : 1;
}

// The origin of a light. v4 moves `from` by the CTM; v3 puts the origin of the CTM to it.
Point3d origin(const LightMaker& m) {
  const auto from = m.parameters.triple("from").value_or(std::array<double, 3>{});
  if (m.scope.context.version == Version::v4) return transform_point(m.ctm, {from[0], from[1], from[2]});
  return transform_point(m.ctm, {0, 0, 0}) + Vector3d{from[0], from[1], from[2]};
}

LightModel point_light(const LightMaker& m) {
  const Point3d position = origin(m);
  return PointLight{position, m.emission("I", power_factor(m, 4 * pi))};
}

// Takes +z to `z` (unit) and is the identity where they agree.
Transform frame(Vector3d z) { return transform_of(Frame(z)); }

LightModel spot_light(const LightMaker& m) {
  const bool v3 = m.scope.context.version == Version::v3;
  const double full = m.parameters.number("coneangle", 30);
  const double delta = m.parameters.number("conedeltaangle", 5);
  const auto from = m.parameters.triple("from").value_or(std::array<double, 3>{});
  const auto to = m.parameters.triple("to").value_or(std::array<double, 3>{0, 0, 1});
  const Vector3d along{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (!(length(along) > 0)) fail("a spot light needs two different points from and to", m.parameters.place());
  const double end = std::cos(full * pi / 180), start = std::cos((full - delta) * pi / 180);
  SpotLight light;
  light.light_to_world = m.ctm * translate({from[0], from[1], from[2]}) * frame(normalize(along));
  light.intensity = m.emission("I", power_factor(m, 2 * pi * ((1 - start) + (start - end) / 2)));
  light.cutoff_deg = static_cast<float>(full);
  light.beam_deg = static_cast<float>(full - delta);
  light.falloff = v3 ? SpotLight::Falloff::quartic : SpotLight::Falloff::smoothstep;
  return light;
}

LightModel projection_light(const LightMaker& m) {
  ProjectionLight light;
  light.light_to_world = m.ctm;
  const Parameter* file = m.image();
  if (!file) fail("a projection light needs a \"string filename\"", m.parameters.place());
  const Id<Texture> image = add_image(*file, m.encoding_of_image(), m.scope);
  light.image = image;
  if (m.scope.context.version == Version::v4)  // texel by texel
    std::get<ImageTexture>(m.scope.made.at(image.value).model).filter = TextureFilter::nearest;
  light.scale = m.factor_of_image("I");
  light.fov_deg =
      static_cast<float>(m.parameters.number("fov", m.scope.context.version == Version::v3 ? 45 : 90));
  light.power = m.optional_number("power");
  return light;
}

LightModel goniometric_light(const LightMaker& m) {
  GoniometricLight light;
  light.light_to_world = m.ctm;
  const Parameter* file = m.image();
  if (!file) return PointLight{transform_point(m.ctm, {0, 0, 0}), m.emission("I", power_factor(m, 4 * pi))};
  light.filename = find_file(*file, m.scope.context);
  expect_map_of_sphere(light.filename, *file, m.scope.context);
  light.intensity = m.emission("I");
  light.latitude_longitude = m.scope.context.version == Version::v3;
  light.power = m.optional_number("power");
  light.encoding = m.encoding_of_image();
  if (light.latitude_longitude) {
    m.approximated("the colours of its image count by their luminance");
    light.number = ImageNumber::luminance;
  }
  return light;
}

LightModel distant_light(const LightMaker& m) {
  const auto from = m.parameters.triple("from").value_or(std::array<double, 3>{0, 0, 0});
  const auto to = m.parameters.triple("to").value_or(std::array<double, 3>{0, 0, 1});
  const Vector3d way{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const Vector3d direction = unit(transform_vector(m.ctm, way));
  if (!(length(direction) > 0))
    fail("a distant light needs two different points from and to", m.parameters.place());
  const double illuminance = m.parameters.number("illuminance", -1);
  return DistantLight{direction, m.emission("L", illuminance > 0 ? illuminance : 1)};
}

std::optional<std::array<Point3d, 4>> read_portal(const LightMaker& m) {
  const Parameter* portal = m.parameters.find_numbers("portal");
  if (!portal) return std::nullopt;
  if (portal->numbers.size() != 12) fail("a portal needs four points", portal->place);
  std::array<Point3d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const double* v = &portal->numbers[3 * i];
    corners[i] = transform_point(m.ctm, {v[0], v[1], v[2]});
  }
  return corners;
}

// An extension: "string sky" with the words of --sky. As of pbrt's images, +z is up; +y is north, +x east.
LightModel sky_light(const LightMaker& m, const Parameter& words) {
  if (words.strings.size() != 1) fail("a sky takes one string", words.place);
  try {
    SkyLight light = parse_sky(words.strings.front()).light;
    light.light_to_world = m.ctm;
    return light;
  } catch (const UsageError& error) {
    fail(error.what(), words.place);
  }
}

LightModel infinite_light(const LightMaker& m) {
  m.parameters.ignore({"nsamples", "samples"});
  if (const Parameter* words = m.parameters.find("sky", {ParameterType::text}); words)
    return sky_light(m, *words);
  const Parameter* file = m.image();
  if (!file) {
    const double illuminance = m.parameters.number("illuminance", -1);
    return InfiniteLight{m.emission("L", illuminance > 0 ? illuminance / pi : 1)};
  }
  EnvironmentLight light;
  light.filename = find_file(*file, m.scope.context);
  expect_map_of_sphere(light.filename, *file, m.scope.context);
  light.light_to_world = m.ctm;
  light.projection = m.scope.context.version == Version::v3 ? EnvironmentLight::Projection::latitude_longitude
                                                            : EnvironmentLight::Projection::equal_area;
  light.scale = m.factor_of_image("L");
  if (const auto named = m.optional_number("illuminance")) light.illuminance = *named * sky_per_illuminance;
  light.portal = read_portal(m);
  light.encoding = m.encoding_of_image();
  light.primaries = primaries_taken(m.scope.context.version);
  return light;
}

struct LightKind {
  std::string_view name;
  LightModel (*make)(const LightMaker&);
};
constexpr std::array<LightKind, 7> light_kinds{{{"point", point_light},
                                                {"spot", spot_light},
                                                {"projection", projection_light},
                                                {"goniometric", goniometric_light},
                                                {"distant", distant_light},
                                                {"infinite", infinite_light},
                                                {"exinfinite", infinite_light}}};

}  // namespace

std::optional<Light> make_light(const std::string& kind, ParameterSet& parameters, const Transform& ctm,
                                const Scope& scope) {
  const LightMaker maker{kind, parameters, ctm, scope};
  std::vector<std::string> names;
  for (const LightKind& known : light_kinds) {
    names.emplace_back(known.name);
    if (kind != known.name) continue;
    Light light{known.make(maker), scope.origin};
    parameters.report_unused(scope.context.report);
    return light;
  }
  scope.context.report.dropped(fmt::format("light \"{}\" is not known{}", kind, suggestion(kind, names)),
                               parameters.place());
  return std::nullopt;
}

AreaEmission make_area_emission(const std::string& kind, ParameterSet& parameters, const Scope& scope) {
  const Transform identity;
  const LightMaker maker{kind, parameters, identity, scope};
  if (kind != "diffuse" && kind != "area") maker.approximated("is not known and read as \"diffuse\"");
  parameters.ignore({"nsamples", "samples"});
  AreaEmission emission;
  emission.place = parameters.place();
  emission.power = parameters.number("power", 0);
  emission.light.two_sided = parameters.boolean("twosided", false);
  emission.light.origin = scope.origin;
  if (const Parameter* file = maker.image()) {
    const Id<Texture> image = add_image(*file, Encoding::automatic, scope);
    std::get<ImageTexture>(scope.made.at(image.value).model).wrap = Wrap::clamp;
    emission.light.radiance = image;
    emission.light.scale = static_cast<float>(parameters.number("scale", 1));
  } else {
    emission.light.radiance = maker.emission("L");
  }
  parameters.report_unused(scope.context.report);
  return emission;
}

}  // namespace vitrail::pbrt
