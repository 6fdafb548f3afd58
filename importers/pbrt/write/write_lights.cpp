// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "images/image_files.h"
#include "importers/images/sky_image.h"
#include "importers/pbrt/read/lights.h"
#include "importers/pbrt/write/write_images.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/physical_light.h"
#include "importers/writing/spot_falloff.h"

namespace vitrail::pbrt {

namespace {

// Writes the parameters of one light; gives its kind, or nothing where it is dropped.
class LightWriter {
 public:
  explicit LightWriter(Parameters& p) : p_(p) {}

  const Transform& light_to_world() const { return light_to_world_; }

  const char* operator()(const PointLight& l) {
    p_.numbers("point3 from", std::array{l.position.x, l.position.y, l.position.z})
        .emission("I", intensity(l, l.position));
    return "point";
  }
  const char* operator()(SpotLight l) {
    light_to_world_ = l.light_to_world;
    l.intensity = intensity(l, transform_point(l.light_to_world, {0, 0, 0}));
    if (l.tightness != 0) p_.approximated(fmt::format("its tightness {} is left out", l.tightness));
    if (l.texture && textured_spot(l)) return "projection";
    const MatchedSpot spot = matched_spot(l, SpotLight::Falloff::smoothstep);
    if (spot.difference > 0)
      p_.approximated(fmt::format(
          "it falls off as pbrt-v4's smoothstep of the cosine: of the same flux, its intensity is within "
          "{:.2g} of the greatest",
          spot.difference));
    if (l.texture) p_.dropped("the texture of a spot light");
    p_.number("coneangle", static_cast<float>(spot.cutoff_deg));
    // With 0 pbrt-v4 finds no light at all.
    p_.number("conedeltaangle", std::max(spot.cutoff_deg - spot.beam_deg, 0.01));
    p_.emission("I", l.intensity);
    return "spot";
  }
  const char* operator()(const ProjectionLight& l) {
    light_to_world_ = l.light_to_world;
    const auto* texture = std::get_if<Id<Texture>>(&*l.image);
    if (!texture && l.irradiance) return uniform_irradiance(l);
    const ImageScale scale = scale_of(l.scale);
    ImageChange change{scale.tint};
    if (l.irradiance) {
      change.cosine_power = -3, change.half = half_size(l, aspect_of(l.image));
      change.mapping = {1, 0, 0, 0, -1, 1};  // Mitsuba's v runs down
    }
    const auto file = texture ? file_for_pbrt(p_, *texture, ImageUse::light, change) : std::nullopt;
    if (!file) {
      p_.dropped("a projection of something that is not an image");
      return nullptr;
    }
    p_.file("filename", *file);
    if (const auto shown = tinted_image(p_.writer().scene, *texture);
        shown && shown->image.filter != TextureFilter::nearest)
      p_.approximated("pbrt shows a projection texel by texel");
    if (l.irradiance) {
      p_.number("fov", std::atan(std::min(change.half.x, change.half.y)) * 360 / std::numbers::pi);
      p_.number("scale", static_cast<float>(scale.number * std::numbers::pi));
    } else {
      p_.number("fov", l.fov_deg).number("scale", static_cast<float>(scale.number));
    }
    if (l.power) p_.number("power", *l.power);
    return "projection";
  }
  const char* operator()(const GoniometricLight& l) {
    light_to_world_ = l.light_to_world;
    p_.file("filename", goniometric_for_pbrt(p_, l)).emission("I", l.intensity);
    if (l.power) p_.number("power", *l.power);
    return "goniometric";
  }
  const char* operator()(const DistantLight& l) {
    p_.numbers("point3 from", std::array{0, 0, 0});
    p_.numbers("point3 to", std::array{l.direction.x, l.direction.y, l.direction.z})
        .emission("L", l.irradiance);
    return "distant";
  }
  const char* operator()(const InfiniteLight& l) {
    p_.emission("L", l.radiance);
    return "infinite";
  }
  const char* operator()(const EnvironmentLight& l) {
    light_to_world_ = l.light_to_world;
    const ImageScale scale = scale_of(l.scale);
    p_.file("filename", environment_for_pbrt(p_, l, scale.tint))
        .number("scale", static_cast<float>(scale.number));
    if (l.illuminance) p_.number("illuminance", *l.illuminance / sky_per_illuminance);
    if (*l.portal) portal(**l.portal);
    return "infinite";
  }
  const char* operator()(const SkyLight&) { return nullptr; }  // its parts are written

 private:
  Spectrum intensity(const auto& l, Point3d position) {
    const PhysicalLight light = physical_light(p_.writer().scene, l.fading, position);
    if (!light.note.empty()) p_.approximated(light.note);
    return light.factor == 1 ? l.intensity : scaled(l.intensity, light.factor);
  }
  // A projection of its texture, dark beyond its edge; false where that is no image.
  bool textured_spot(const SpotLight& l) {
    ImageChange change{emission_rgb(l.intensity)};
    change.spot = &l;
    const auto file = file_for_pbrt(p_, *l.texture, ImageUse::light, change);
    if (!file) return false;
    if (!is_rgb(l.intensity)) p_.approximated("the intensity of a spot light with a texture is an rgb");
    p_.file("filename", *file).number("fov", 2 * static_cast<double>(l.cutoff_deg));
    return true;
  }
  // pbrt's image is of the intensity.
  const char* uniform_irradiance(const ProjectionLight& l) {
    constexpr int pixels = 64;
    const Point2d half = half_size(l, 1);
    Image image = black_image(pixels, pixels, 3);
    std::ranges::fill(image.values, 1.0f);
    multiply(image, emission_rgb(product(std::get<Spectrum>(*l.image), l.scale)));
    multiply_by_cosine(image, -3, half);
    const std::filesystem::path file = std::filesystem::absolute(p_.writer().new_image());
    write_exr_image(file, image);
    p_.approximated("pbrt projects images alone: it is one of uniform irradiance");
    p_.file("filename", file.string()).number("fov", std::atan(half.x) * 360 / std::numbers::pi);
    p_.number("scale", static_cast<float>(std::numbers::pi));
    if (l.power) p_.number("power", *l.power);
    return "projection";
  }
  // What multiplies an image, as a number and a colour of the image's own.
  struct ImageScale {
    double number = 1;
    RGB tint{1, 1, 1};
  };
  static ImageScale scale_of(const Spectrum& scale) {
    const RGB c = factor_rgb(scale);
    if (c.r == c.g && c.g == c.b) return {c.r, {1, 1, 1}};
    return {1, c};
  }
  double aspect_of(const SpectrumParameter& image) {
    const auto* texture = std::get_if<Id<Texture>>(&image);
    const auto tinted = texture ? tinted_image(p_.writer().scene, *texture) : std::nullopt;
    try {
      const ImageLayout layout = read_image_layout(tinted ? tinted->image.filename : "");
      return static_cast<double>(layout.width) / layout.height;
    } catch (const Error&) {
      return 1;
    }
  }
  void portal(const std::array<Point3d, 4>& corners) {
    const Transform to_light = inverse(light_to_world_);
    std::vector<double> numbers;
    for (const Point3d& corner : corners) {
      const Point3d p = transform_point(to_light, corner);
      numbers.insert(numbers.end(), {p.x, p.y, p.z});
    }
    p_.numbers("point3 portal", numbers);
  }

  Parameters& p_;
  Transform light_to_world_;
};

constexpr std::array light_names{"point",   "spot",     "projection",  "goniometric",
                                 "distant", "infinite", "environment", "sky"};
static_assert(light_names.size() == std::variant_size_v<LightVariant>);

void write_light(Writer& w, const Light& light) {
  Parameters p(w, fmt::format("{} light", light_names.at(light.model.index())), light.origin,
               RecordKind::light);
  if (const auto* sky = std::get_if<SkyLight>(&light.model)) {
    p.approximated("pbrt has no sky: its image in linear sRGB, and the sun as parallel light");
    const auto file = std::filesystem::absolute(w.new_image());
    for (const LightModel& part : sky_as_image(*sky, EnvironmentLight::Projection::equal_area, file))
      write_light(w, {part, light.origin});
    return;
  }
  LightWriter writer(p);
  const char* kind = std::visit(writer, light.model);
  if (!kind) return;
  const bool moved = writer.light_to_world() != Transform{};
  if (moved) w.begin("AttributeBegin"), w.transform(writer.light_to_world());
  w.line(fmt::format("LightSource \"{}\"{}", kind, p.list()));
  if (moved) w.end("AttributeEnd");
}

}  // namespace

// pbrt is killed at random where light goes from one that stands in a vacuum to surfaces in a fog: lights
// stand in what is around the camera.
void write_lights(Writer& w) {
  const bool in_medium = w.scene.camera_medium && !w.scene.lights.empty();
  if (in_medium) w.line("MediumInterface \"\" " + in_quotes(w.media.at(w.scene.camera_medium->value)));
  for (const Light& light : w.scene.lights) write_light(w, light);
  if (in_medium) w.line("MediumInterface \"\" \"\"");
}

}  // namespace vitrail::pbrt
