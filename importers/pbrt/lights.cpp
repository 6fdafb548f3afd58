// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/lights.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/rgb_to_spectrum.h"

namespace vitrail::pbrt {

namespace {

using std::numbers::pi;

struct Maker {
  const std::string& kind;
  ParameterSet& parameters;
  const Transform& ctm;
  SpectrumScope scope;

  // The emission under `name`, white of luminance 1 where it is not given, times `scale` and `factor`.
  Spectrum emission(std::string_view name, double factor = 1) const {
    const Parameter* parameter = parameters.find_spectrum(name);
    const Spectrum spectrum =
        parameter ? read_emission(*parameter, scope) : Spectrum{emission_from_rgb({1, 1, 1})};
    const Parameter* scale = parameters.find_spectrum("scale");  // in v3 a spectrum
    if (!scale) return scaled(spectrum, factor);
    if (scale->type == ParameterType::number) return scaled(spectrum, factor * parameters.number("scale", 1));
    const Spectrum product_of_both = product(spectrum, read_scale(*scale));
    return scaled(product_of_both, factor);
  }

  void approximated(const std::string& how) const {
    scope.context.report.approximated(fmt::format("light \"{}\": {}", kind, how), parameters.place());
  }

 private:
  // Grey factors, whatever their size, are exact; a colour is a reflectance times its greatest component.
  Spectrum read_scale(const Parameter& parameter) const {
    double greatest = 0;
    for (const double value : parameter.numbers) greatest = std::max(greatest, value);
    if (parameter.type != ParameterType::rgb || greatest <= 0) return read_reflectance(parameter, scope);
    Parameter color = parameter;
    for (double& value : color.numbers) value /= greatest;
    return scaled(read_reflectance(color, scope), greatest);
  }
};

// Where the luminous `power` is given, what it divides by; else 1.
double power_factor(const Maker& m, double steradians) {
  const double power = m.parameters.number("power", -1);
  return power > 0 ? power / steradians : 1;
}

// The origin of a light. v4 moves `from` by the CTM; v3 puts the origin of the CTM to it.
Point3d origin(const Maker& m) {
  const auto from = m.parameters.triple("from").value_or(std::array<double, 3>{});
  if (m.scope.context.version == Version::v4) return transform_point(m.ctm, {from[0], from[1], from[2]});
  return transform_point(m.ctm, {0, 0, 0}) + Vector3d{from[0], from[1], from[2]};
}

Light point_light(const Maker& m) {
  const Point3d position = origin(m);
  return PointLight{position, m.emission("I", power_factor(m, 4 * pi))};
}

// Cone angles and images only dim a point light in some directions: it is imported with its greatest
// intensity.
Light spot_light(const Maker& m) {
  const double full = m.parameters.number("coneangle", 30) * pi / 180;
  const double delta = m.parameters.number("conedeltaangle", m.parameters.number("conedelta", 5)) * pi / 180;
  const double end = std::cos(full), start = std::cos(full - delta);
  const auto from = m.parameters.triple("from").value_or(std::array<double, 3>{});
  m.parameters.ignore({"to"});
  m.approximated("shines in all directions, like its middle");
  return PointLight{transform_point(m.ctm, {from[0], from[1], from[2]}),
                    m.emission("I", power_factor(m, 2 * pi * ((1 - start) + (start - end) / 2)))};
}

Light image_light(const Maker& m) {
  m.parameters.ignore({"filename", "mapname", "fov", "power"});
  m.approximated("shines in all directions; its image is left out");
  return PointLight{transform_point(m.ctm, {0, 0, 0}), m.emission("I")};
}

Light distant_light(const Maker& m) {
  const auto from = m.parameters.triple("from").value_or(std::array<double, 3>{0, 0, 0});
  const auto to = m.parameters.triple("to").value_or(std::array<double, 3>{0, 0, 1});
  const Vector3d way{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const Vector3d direction = normalize(transform_vector(m.ctm, way));
  if (!(length(direction) > 0))
    fail("a distant light needs two different points from and to", m.parameters.place());
  const double illuminance = m.parameters.number("illuminance", -1);
  return DistantLight{direction, m.emission("L", illuminance > 0 ? illuminance : 1)};
}

Light infinite_light(const Maker& m) {
  m.parameters.ignore({"nsamples", "samples"});
  for (const char* name : {"filename", "mapname"})
    if (m.parameters.find(name, {ParameterType::text}))
      m.approximated("the constant L (1 where it is not given) stands for the environment image");
  if (m.parameters.find_numbers("portal")) m.approximated("the portal is left out");
  const double illuminance = m.parameters.number("illuminance", -1);
  return InfiniteLight{m.emission("L", illuminance > 0 ? illuminance / pi : 1)};
}

}  // namespace

std::optional<Light> make_light(const std::string& kind, ParameterSet& parameters, const Transform& ctm,
                                SpectrumScope scope) {
  const Maker maker{kind, parameters, ctm, scope};
  std::optional<Light> light;
  if (kind == "point")
    light = point_light(maker);
  else if (kind == "spot")
    light = spot_light(maker);
  else if (kind == "goniometric" || kind == "projection")
    light = image_light(maker);
  else if (kind == "distant")
    light = distant_light(maker);
  else if (kind == "infinite" || kind == "exinfinite")
    light = infinite_light(maker);
  if (light) {
    parameters.report_unused(scope.context.report);
    return light;
  }
  const std::string closest =
      closest_word(kind, {"point", "spot", "goniometric", "projection", "distant", "infinite"});
  scope.context.report.dropped(
      fmt::format("light \"{}\" is not known{}", kind,
                  closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
      parameters.place());
  return std::nullopt;
}

AreaEmission make_area_emission(const std::string& kind, ParameterSet& parameters, SpectrumScope scope) {
  const Transform identity;
  const Maker maker{kind, parameters, identity, scope};
  if (kind != "diffuse" && kind != "area") maker.approximated("is not known and read as \"diffuse\"");
  parameters.ignore({"nsamples", "samples"});
  AreaEmission emission;
  emission.place = parameters.place();
  emission.power = parameters.number("power", 0);
  emission.light.two_sided = parameters.boolean("twosided", false);
  emission.light.radiance = maker.emission("L");
  if (parameters.find("filename", {ParameterType::text}))
    maker.approximated("the constant L (1 where it is not given) stands for the image");
  parameters.report_unused(scope.context.report);
  return emission;
}

}  // namespace vitrail::pbrt
