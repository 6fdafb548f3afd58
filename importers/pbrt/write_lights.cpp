// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "importers/images/sky_image.h"
#include "importers/pbrt/write_images.h"

namespace vitrail::pbrt {

namespace {

// Writes the parameters of one light; gives its kind, or nothing where it is dropped.
class LightWriter {
 public:
  explicit LightWriter(Parameters& p) : p_(p) {}

  const Transform& light_to_world() const { return light_to_world_; }

  const char* operator()(const PointLight& l) {
    p_.numbers("point3 from", std::array{l.position.x, l.position.y, l.position.z})
        .emission("I", l.intensity);
    return "point";
  }
  const char* operator()(const SpotLight& l) {
    light_to_world_ = l.light_to_world;
    if (l.falloff != SpotLight::Falloff::smoothstep)
      p_.approximated("between the two angles it falls off as pbrt-v4's smoothstep of the cosine");
    if (l.texture) p_.dropped("the texture of a spot light");
    p_.number("coneangle", l.cutoff_deg);
    p_.number("conedeltaangle", static_cast<double>(l.cutoff_deg) - static_cast<double>(l.beam_deg));
    p_.emission("I", l.intensity);
    return "spot";
  }
  const char* operator()(const ProjectionLight& l) {
    light_to_world_ = l.light_to_world;
    const auto* texture = std::get_if<Id<Texture>>(&l.image);
    const auto file = texture ? file_for_pbrt(p_, *texture, ImageUse::light) : std::nullopt;
    if (!file) {
      p_.dropped("a projection of something that is not an image");
      return nullptr;
    }
    if (l.irradiance)
      p_.approximated("the image is of the intensity, not of the irradiance on a plane (less by cos³)");
    p_.file("filename", *file).number("fov", l.fov_deg);
    scale_of_image(l.scale);
    if (l.power) p_.number("power", *l.power);
    return "projection";
  }
  const char* operator()(const GoniometricLight& l) {
    light_to_world_ = l.light_to_world;
    if (l.latitude_longitude)
      p_.approximated("its image is of latitude and longitude, but pbrt-v4 reads it as the equal-area map");
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
    p_.file("filename", environment_for_pbrt(p_, l));
    scale_of_image(l.scale);
    if (l.illuminance) p_.number("illuminance", *l.illuminance);
    if (l.portal) portal(*l.portal);
    return "infinite";
  }
  const char* operator()(const SkyLight&) { return nullptr; }  // its parts are written

 private:
  void scale_of_image(const Spectrum& scale) {
    if (!is_constant(scale)) p_.approximated("the colour that multiplies its image becomes its luminance");
    p_.number("scale",
              static_cast<float>(is_constant(scale) ? evaluate(scale, lambda_min_nm) : luminance(scale)));
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

constexpr std::array kinds{"point",   "spot",     "projection",  "goniometric",
                           "distant", "infinite", "environment", "sky"};
static_assert(kinds.size() == std::variant_size_v<LightVariant>);

void write_light(Writer& w, const Light& light) {
  Parameters p(w, fmt::format("{} light", kinds.at(light.model.index())), light.origin, RecordKind::light);
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

void write_lights(Writer& w) {
  for (const Light& light : w.scene.lights) write_light(w, light);
}

}  // namespace vitrail::pbrt
