// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/rgb_variants.h"

#include <algorithm>
#include <cmath>

#include "importers/mitsuba/write/write_spectra.h"
#include "importers/writing/export_colors.h"
#include "scene/records/field_search.h"
#include "scene/spectra/color.h"

namespace vitrail::mitsuba_writer {

namespace {

// Linear between samples in order, 0 beyond them.
double at(const std::vector<SpectrumSample>& samples, double lambda_nm) {
  const auto above = std::ranges::lower_bound(samples, lambda_nm, {}, [](const auto& s) { return s[0]; });
  if (above == samples.end()) return 0;
  if (above == samples.begin()) return (*above)[0] == lambda_nm ? (*above)[1] : 0;
  const SpectrumSample &a = *(above - 1), &b = *above;
  return a[1] + (b[1] - a[1]) * (lambda_nm - a[0]) / (b[0] - a[0]);
}

// x̄, ȳ or z̄.
double observer(std::size_t component, double lambda_nm) {
  const double place = lambda_nm - lambda_min_nm;
  const auto lower = std::min(static_cast<std::size_t>(place), std::size_t{table_size - 2});
  const double share = place - static_cast<double>(lower);
  return (1 - share) * static_cast<double>(cie_1931()[lower][component]) +
         share * static_cast<double>(cie_1931()[lower + 1][component]);
}

}  // namespace

double luminance_in_rgb_variants(const Spectrum& emission) {
  const auto* table = std::get_if<TabulatedSpectrum>(&emission);
  const double own = to_xyz(emission).y;
  if (!table || !(own > 0)) return 1;
  const std::vector<SpectrumSample> samples = samples_of(*table);
  constexpr int places = 1000;
  const double step = static_cast<double>(table_size - 1) / (places - 1);
  std::array<double, 3> sum{};
  for (int i = 0; i < places; ++i) {
    const double lambda_nm = lambda_min_nm + i * step, value = at(samples, lambda_nm);
    if (value == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += value * observer(c, lambda_nm) * step / cie_y_integral_nm;
  }
  const RGB rgb = xyz_to_srgb({sum[0], sum[1], sum[2]});
  return srgb_to_xyz({std::max(rgb.r, 0.0), std::max(rgb.g, 0.0), std::max(rgb.b, 0.0)}).y / own;
}

void report_rgb_variants(Context& context, const Spectrum& emission) {
  const double times = luminance_in_rgb_variants(emission);
  if (std::abs(times - 1) <= 0.01) return;
  context.approximated(
      fmt::format("Mitsuba's rgb variants look at a spectrum every .47 nm and cut colours outside of sRGB: "
                  "there this light is {:.2g} times as bright",
                  times));
}

namespace {

// Of more colours than this no products are looked at.
constexpr std::size_t most_colours = 64;

// The spectra in records that colour light; of too many one more than are looked at.
struct Colours : FieldSearch<Colours> {
  using FieldSearch::in;
  std::vector<Spectrum> found;

  void in(const Spectrum& s) {
    if (found.size() <= most_colours && std::ranges::find(found, s) == found.end()) found.push_back(s);
  }
  void in(const SpectrumParameter& p) {
    if (const auto* s = std::get_if<Spectrum>(&p)) in(*s);
  }
  // What colours no light that is reflected once.
  void in(const ComplexIndex&) {}
  void in(const SubsurfaceMaterial&) {}
  void in(const DielectricMaterial&) {}
};

using Values = std::array<double, table_size>;
Values values_of(const Spectrum& spectrum) {
  const Spectrum table = resolved(spectrum);
  Values values;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = evaluate(table, lambda_min_nm + static_cast<double>(i));
  return values;
}
double luminance_of(const Values& light, const Values* reflectance) {
  double sum = 0;
  for (std::size_t i = 0; i < light.size(); ++i)
    sum += light[i] * (reflectance ? (*reflectance)[i] : 1) * static_cast<double>(cie_1931()[i][1]);
  return sum;
}

}  // namespace

void report_products_in_rgb_variants(Context& context) {
  const Scene& scene = context.scene;
  if (is_mitsuba_file(scene, scene.camera_origin)) return;
  Colours lights, surfaces;
  for (const Light& light : scene.lights) lights.in(static_cast<const LightVariant&>(light.model));
  for (const AreaLight& light : scene.area_lights) lights.in(light.radiance);
  for (const Material& material : scene.materials)
    surfaces.in(static_cast<const MaterialVariant&>(material.model));
  if (lights.found.size() > most_colours || surfaces.found.size() > most_colours) return;
  double worst = 1;
  for (const Spectrum& surface : surfaces.found) {
    if (is_constant(surface)) continue;
    const Values reflectance = values_of(surface);
    const RGB b = color_of(surface);
    for (const Spectrum& light : lights.found) {
      const Values emission = values_of(light);
      const RGB a = is_constant(light) ? RGB{1, 1, 1} : emission_rgb(light);
      const double own = luminance_of(emission, &reflectance) / luminance_of(emission, nullptr),
                   times = srgb_to_xyz({a.r * b.r, a.g * b.g, a.b * b.b}).y / srgb_to_xyz(a).y / own;
      if (std::abs(times - 1) > std::abs(worst - 1)) worst = times;
    }
  }
  if (std::abs(worst - 1) <= 0.02) return;
  context.begin(RecordKind::any, scene.camera_origin);
  context.approximated(
      fmt::format("Mitsuba's rgb variants multiply three numbers for spectra: of light on a surface they "
                  "show up to {:.3g} times "
                  "as much, once reflected",
                  worst));
}

double tenth_in_rgb_variants(const Spectrum& extinction) {
  const Values sigma = values_of(extinction), daylight = values_of(NamedSpectrum{"stdillum-D65"});
  const auto transmitted = [&](double depth) {
    Values left;
    std::ranges::transform(sigma, left.begin(),
                           [&](double s) { return std::exp(-std::max(0.0, s) * depth); });
    return luminance_of(daylight, &left) / luminance_of(daylight, nullptr);
  };
  const double greatest = *std::ranges::max_element(sigma);
  if (!(greatest > 0)) return 0.1;
  double low = 0, high = 1 / greatest;
  while (transmitted(high) > 0.1 && high < 1e6 / greatest) low = high, high *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (transmitted(middle) > 0.1 ? low : high) = middle;
  }
  const RGB color = color_of(extinction);
  const auto passes = [&](double c) { return std::exp(-std::max(0.0, c) * low); };
  return srgb_to_xyz({passes(color.r), passes(color.g), passes(color.b)}).y;
}

bool is_mitsuba_file(const Scene& scene, const Origin& origin) {
  return origin.file < scene.files.size() &&
         std::filesystem::path(scene.files[origin.file]).extension() == ".xml";
}

}  // namespace vitrail::mitsuba_writer
