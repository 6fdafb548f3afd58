// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "images/image_files.h"
#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/read/sun_and_sky.h"
#include "importers/reading/suggestion.h"
#include "scene/records/light_traits.h"
#include "scene/spectra/flat_emission.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail::mitsuba {

namespace {

// White of luminance 1: what an emitter without any colour has.
Spectrum white() { return emission_from_rgb({1, 1, 1}); }

Spectrum emission(Builder& builder, const Object& emitter, std::string_view name) {
  return spectrum_value(builder, emitter, name, Quantity::emission, white());
}

bool is_texture(const Object* object) { return object && object->tag == "texture"; }

// What a texture that shines is times, beside D65: 1 inside of a "d65", the inverse of D65 where it stands by
// itself, which leaves it the flat white that Mitsuba's spectral variants have.
struct EmitterImage {
  SpectrumParameter colors;
  Spectrum scale = ConstantSpectrum{1};
};

EmitterImage image_of(Builder& builder, const Object& emitter, std::string_view name) {
  const Object* texture = object_of(emitter, name);
  EmitterImage image;
  if (!is_texture(texture) || texture->type != "d65") {
    image.colors = spectrum_parameter(builder, emitter, name, Quantity::emission, white());
    if (std::holds_alternative<Id<Texture>>(image.colors)) image.scale = inverse_d65();
    return image;
  }
  const auto nested = texture->children("texture");
  if (nested.empty()) {
    image.colors = spectrum_parameter(builder, emitter, name, Quantity::emission, white());
    return image;
  }
  image.scale = ConstantSpectrum{static_cast<float>(texture->number("scale", 1, builder.report))};
  report_unused(*texture, builder.report, {"scale"});
  image.colors = add_texture(builder, *std::get<ObjectPtr>(nested.front()->value), false);
  return image;
}

// One of the two: a property of its own, or the transform.
bool is_given(const Builder& builder, const Object& emitter, std::string_view name) {
  if (!emitter.has(name)) return false;
  if (emitter.has("to_world"))
    builder.report.fail(
        fmt::format("emitter \"{}\" takes a \"{}\" or a \"to_world\", not both", emitter.type, name),
        place_of(emitter, "to_world"));
  return true;
}

LightModel point(Builder& builder, const Object& emitter) {
  Point3d position = transform_point(emitter.transform("to_world", builder.report), {0, 0, 0});
  if (is_given(builder, emitter, "position"))
    if (const auto given = emitter.vector("position", builder.report))
      position = {given->x, given->y, given->z};
  return PointLight{position, emission(builder, emitter, "intensity")};
}

// A texture multiplies the intensity, be it one colour or an image.
void read_spot_texture(Builder& builder, const Object& emitter, SpotLight& light) {
  if (!emitter.has("texture")) return;
  const SpectrumParameter texture =
      spectrum_parameter(builder, emitter, "texture", Quantity::reflectance, ConstantSpectrum{1});
  if (const auto* color = std::get_if<Spectrum>(&texture))
    light.intensity = product(light.intensity, *color);
  else
    light.texture = std::get<Id<Texture>>(texture);
}

LightModel spot(Builder& builder, const Object& emitter) {
  const Report& report = builder.report;
  const double cutoff = emitter.number("cutoff_angle", 20, report),
               beam = emitter.number("beam_width", cutoff * 3 / 4, report);
  if (!(cutoff > 0 && cutoff <= 180 && beam >= 0))
    report.fail(fmt::format("a spot of a cutoff_angle of {} and a beam_width of {} degrees", cutoff, beam),
                place_of(emitter, "cutoff_angle"));
  SpotLight light;
  light.light_to_world = emitter.transform("to_world", report);
  light.intensity = emission(builder, emitter, "intensity");
  light.cutoff_deg = static_cast<float>(cutoff);
  light.beam_deg = static_cast<float>(std::min(beam, cutoff));
  light.falloff = SpotLight::Falloff::linear;
  read_spot_texture(builder, emitter, light);
  return light;
}

// Width ÷ height of an image; 1 of one colour, and of what cannot be read, which is told where it is baked.
double aspect_of(const Scene& scene, const SpectrumParameter& image) {
  const auto* id = std::get_if<Id<Texture>>(&image);
  if (!id) return 1;
  const TextureModel* model = &scene.textures[id->value].model;
  if (const auto* product = std::get_if<ProductTexture>(model))
    if (const auto* first = std::get_if<Id<Texture>>(&product->first))
      model = &scene.textures[first->value].model;
  const auto* texture = std::get_if<ImageTexture>(model);
  if (!texture) return 1;
  try {
    const ImageLayout layout = read_image_layout(texture->filename);
    return static_cast<double>(layout.width) / layout.height;
  } catch (const Error&) {
    return 1;
  }
}

// On the image's width, in degrees. 50 mm and the diagonal of a film of 36 × 24 mm are Mitsuba's defaults.
double read_projector_fov(Builder& builder, const Object& emitter, double aspect) {
  Report& report = builder.report;
  const bool given = emitter.has("fov");
  const double diagonal_deg = 2 * std::atan(std::hypot(36, 24) / (2 * 50.0)) * 180 / std::numbers::pi;
  const double fov = given ? emitter.number("fov", 50, report) : diagonal_deg;
  const std::string axis = emitter.text("fov_axis", given ? "x" : "diagonal", report);
  if (!(fov > 0 && fov < 180))
    report.fail(fmt::format("the field of view is {} degrees, which is not between 0 and 180", fov),
                place_of(emitter, "fov"));
  double wider = 1;  // the width is so many times what the angle is measured along
  if (axis == "y" || (axis == "smaller" && aspect > 1) || (axis == "larger" && aspect < 1)) wider = aspect;
  if (axis == "diagonal") wider = aspect / std::hypot(aspect, 1);
  if (wider == 1) return fov;
  return 2 * std::atan(wider * std::tan(fov / 2 * std::numbers::pi / 180)) * 180 / std::numbers::pi;
}

// Mitsuba's projector is a camera, whose +x is on the left.
LightModel projector(Builder& builder, const Object& emitter) {
  ProjectionLight light;
  light.light_to_world = emitter.transform("to_world", builder.report) * scale({-1, 1, 1});
  const EmitterImage image = image_of(builder, emitter, "irradiance");
  light.image = image.colors;
  light.scale = scaled(image.scale, emitter.number("scale", 1, builder.report));
  light.fov_deg =
      static_cast<float>(read_projector_fov(builder, emitter, aspect_of(builder.scene, light.image)));
  light.irradiance = true;
  return light;
}

LightModel directional(Builder& builder, const Object& emitter) {
  Vector3d direction = transform_vector(emitter.transform("to_world", builder.report), {0, 0, 1});
  if (is_given(builder, emitter, "direction"))
    if (const auto given = emitter.vector("direction", builder.report)) direction = *given;
  const Vector3d along = unit(direction);
  if (!(length(along) > 0))
    builder.report.fail("the direction of a light has no length", place_of(emitter, "direction"));
  if (const double size = length(direction); !emitter.has("direction") && std::abs(size - 1) > 1e-3)
    builder.report.approximated(
        fmt::format(
            "to_world scales a directional light by {:.4g}: the irradiance holds as it is given; Mitsuba "
            "multiplies what diffuse surfaces have of it",
            size),
        place_of(emitter, "to_world"));
  return DistantLight{along, emission(builder, emitter, "irradiance")};
}

LightModel constant(Builder& builder, const Object& emitter) {
  return InfiniteLight{emission(builder, emitter, "radiance")};
}

// Mitsuba looks at its map with y up and u = atan2(x, −z)/2π: a direction (x,y,z) of its frame is (−z, x, y)
// of the light's.
Transform light_to_mitsuba() {
  Transform t;
  t.m[0] = {0, 1, 0, 0};
  t.m[1] = {0, 0, 1, 0};
  t.m[2] = {-1, 0, 0, 0};
  return t;
}

bool keeps_lengths(const Transform& t) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = t.m[0][i] * t.m[0][j] + t.m[1][i] * t.m[1][j] + t.m[2][i] * t.m[2][j];
      if (std::abs(product - (i == j ? 1 : 0)) > 1e-3) return false;
    }
  return true;
}

LightModel environment(Builder& builder, const Object& emitter) {
  EnvironmentLight light;
  light.filename = existing_file(builder, emitter, "filename");
  const Transform to_world = emitter.transform("to_world", builder.report);
  if (!keeps_lengths(to_world))
    builder.report.approximated(
        "to_world of an envmap: its turn alone; Mitsuba distorts the image where there is a scale, which is "
        "written to Mitsuba as it is",
        place_of(emitter, "to_world"));
  light.light_to_world = to_world * light_to_mitsuba();
  light.projection = EnvironmentLight::Projection::latitude_longitude;
  light.scale = ConstantSpectrum{static_cast<float>(emitter.number("scale", 1, builder.report))};
  emitter.ignore({"mis_compensation", "cache"});
  return light;
}

struct EmitterKind {
  const char* name;
  LightModel (*make)(Builder&, const Object&);
};
constexpr EmitterKind emitter_kinds[]{{"point", point},         {"spot", spot},
                                      {"projector", projector}, {"directional", directional},
                                      {"constant", constant},   {"envmap", environment}};

const std::vector<std::string> properties{"position",   "to_world", "intensity", "cutoff_angle", "beam_width",
                                          "texture",    "scale",    "fov",       "fov_axis",     "direction",
                                          "irradiance", "radiance", "filename"};

std::vector<std::string> names() {
  std::vector<std::string> all{"area", "directionalarea"};
  for (const EmitterKind& kind : emitter_kinds) all.emplace_back(kind.name);
  return all;
}

// Why an emitter is not one of the scene's, and what to do.
std::string advice(const std::string& kind) {
  if (kind == "skylight")
    return "is dropped: the Scene has no model of the sky; let Mitsuba write it as an image and give that to "
           "an "
           "\"envmap\"";
  if (kind == "area" || kind == "directionalarea") return "is dropped: it belongs into a shape";
  if (kind == "collimated")
    return "is dropped: a beam without width lights no surface; use a narrow \"spot\"";
  return "is not known and dropped" + suggestion(kind, names());
}

}  // namespace

void add_emitter(Builder& builder, const Object& emitter) {
  Report& report = builder.report;
  report.begin_item({emitter.origin, RecordKind::light});
  const bool is_asked_for = emitter.number("sampling_weight", 1, report) > 0;
  if (!emitter.keyframes("to_world").empty())
    report.approximated("motion of an emitter: its first keyframe holds for the whole picture",
                        emitter.origin);
  if (is_daylight(emitter.type)) return add_daylight(builder, emitter);
  for (const EmitterKind& kind : emitter_kinds) {
    if (emitter.type != kind.name) continue;
    Light light{.model = kind.make(builder, emitter), .origin = emitter.origin, .name = name_of(emitter)};
    // Of weight 0, Mitsuba shows only the light that rays meet by themselves.
    if (is_asked_for || traits_of(light.model).surrounds) builder.scene.lights.push_back(std::move(light));
    if (!emitter.children("medium").empty()) {  // a light without a surface is in the medium around it
      report.begin_item({emitter.origin, RecordKind::light});
      report.dropped("the medium of an emitter: the surfaces around it say what it is in", emitter.origin);
    }
    return report_unused(emitter, report, properties);
  }
  report.dropped(fmt::format("emitter \"{}\" {}", emitter.type, advice(emitter.type)), emitter.origin);
}

std::optional<Id<AreaLight>> add_area_light(Builder& builder, const Object& emitter) {
  Report& report = builder.report;
  report.begin_item({emitter.origin, RecordKind::area_light});
  const bool directional = emitter.type == "directionalarea";
  if (emitter.type != "area" && !directional) {
    report.dropped(
        fmt::format("emitter \"{}\" of a shape: only \"area\" and \"directionalarea\" belong there{}",
                    emitter.type, suggestion(emitter.type, {"area", "directionalarea"})),
        emitter.origin);
    return std::nullopt;
  }
  if (directional && builder.integrator.name != "ptracer")
    report.approximated(
        "\"directionalarea\": its light is seen, of which Mitsuba's path tracers show nothing",
        emitter.origin);
  emitter.ignore({"sampling_weight"});
  emitter.children("medium");
  EmitterImage image = image_of(builder, emitter, "radiance");
  AreaLight light{image.colors, 1, false, directional};
  light.origin = emitter.origin;
  light.name = name_of(emitter);
  if (const auto* factor = std::get_if<ConstantSpectrum>(&image.scale)) {
    light.scale = factor->value;
  } else {
    builder.scene.textures.push_back(
        {ProductTexture{image.colors, std::move(image.scale)}, false, "", emitter.origin});
    light.radiance = Id<Texture>{static_cast<std::uint32_t>(builder.scene.textures.size() - 1)};
  }
  report_unused(emitter, report, properties);
  builder.scene.area_lights.push_back(std::move(light));
  return Id<AreaLight>{static_cast<std::uint32_t>(builder.scene.area_lights.size() - 1)};
}

}  // namespace vitrail::mitsuba
