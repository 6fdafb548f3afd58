// SPDX-License-Identifier: Apache-2.0
#include "cli/spectrum/spectrum_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/common/svg.h"
#include "cli/spectrum/color_checker.h"
#include "images/image_files.h"
#include "scene/spectra/matrix_r.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr double step_nm = 5;
double wavelength(std::size_t band) { return lambda_min_nm + step_nm * static_cast<double>(band); }

double largest_difference(RGB a, RGB b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// At 1 nm, held beyond what was measured.
TabulatedSpectrum measured(const ColorCheckerPatch& patch) {
  std::vector<SpectrumSample> samples;
  for (std::size_t i = 0; i < patch.reflectance.size(); ++i)
    samples.push_back({380 + 10 * static_cast<double>(i), patch.reflectance[i]});
  return tabulate(samples, true);
}

std::string polyline(const std::vector<double>& values, double first_nm, double step, double x, double y,
                     const std::vector<SvgAttribute>& stroke) {
  std::string points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double nm = first_nm + step * static_cast<double>(i);
    if (nm < 380 || nm > 780) continue;
    points += fmt::format("{:.1f},{:.1f} ", x + (nm - 380) * 0.35, y + 100 * (1 - values[i]));
  }
  std::vector<SvgAttribute> attributes{{"points", points}, {"fill", "none"}};
  attributes.insert(attributes.end(), stroke.begin(), stroke.end());
  return svg_element("polyline", attributes) + "\n";
}

}  // namespace

const char* name_of(UpsamplingMethod method) {
  return method == UpsamplingMethod::matrix_r ? "Matrix-R" : "Jakob-Hanika";
}

MadeReflectance make_reflectance(UpsamplingMethod method, RGB c) {
  if (method == UpsamplingMethod::matrix_r) {
    const BandReflectance s = matrix_r_reflectance(c);
    return {{s.begin(), s.end()}, reflected_rgb(s)};
  }
  const Spectrum s = reflectance_from_rgb(c);
  MadeReflectance made{{}, reflected_rgb(s)};
  for (std::size_t i = 0; i < matrix_r_bands; ++i) made.values.push_back(evaluate(s, wavelength(i)));
  return made;
}

std::vector<CountedColor> cube_colors(int n) {
  std::vector<CountedColor> colors;
  const auto part = [&](int i) { return static_cast<double>(i) / (n - 1); };
  for (int i = 0; i < n * n * n; ++i) colors.push_back({{part(i / n / n), part(i / n % n), part(i % n)}});
  return colors;
}

std::vector<CountedColor> picture_colors(const std::filesystem::path& file) {
  const Image image = read_linear_image(file);
  std::map<std::array<float, 3>, std::size_t> counts;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t at = 0; at + channels <= image.values.size(); at += channels) {
    std::array<float, 3> color;
    for (std::size_t c = 0; c < 3; ++c) {
      const float v = image.values[at + std::min(c, channels - 1)];
      color[c] = v > 0 ? std::min(v, 1.0f) : 0;  // also of what is not a number
    }
    ++counts[color];
  }
  if (counts.empty()) throw Error("the picture has no pixels", {file.string()});
  std::vector<CountedColor> colors;
  for (const auto& [c, count] : counts)
    colors.push_back(
        {{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}, count});
  return colors;
}

RoundTrip round_trip(UpsamplingMethod method, std::span<const CountedColor> colors) {
  RoundTrip result;
  double errors = 0, roughness = 0, pixels = 0;
  for (const auto& [color, count] : colors) {
    const MadeReflectance made = make_reflectance(method, color);
    const auto weight = static_cast<double>(count);
    const double error = largest_difference(made.rgb, color);
    errors += weight * error;
    result.max_error = std::max(result.max_error, error);
    double squares = 0;
    for (std::size_t k = 0; k < made.values.size(); ++k) {
      result.min_value = std::min(result.min_value, made.values[k]);
      result.max_value = std::max(result.max_value, made.values[k]);
      if (k > 0) squares += std::pow(made.values[k] - made.values[k - 1], 2);
    }
    roughness += weight * std::sqrt(squares / static_cast<double>(made.values.size() - 1));
    pixels += weight;
  }
  result.colors = colors.size();
  result.mean_error = errors / pixels;
  result.roughness = roughness / pixels;
  return result;
}

std::vector<PatchError> patch_errors(UpsamplingMethod method) {
  std::vector<PatchError> errors;
  for (const ColorCheckerPatch& patch : color_checker()) {
    const RGB c = reflected_rgb(Spectrum{measured(patch)});
    const MadeReflectance made = make_reflectance(method, c);
    PatchError error{std::string(patch.name)};
    error.in_gamut = std::min({c.r, c.g, c.b}) >= 0 && std::max({c.r, c.g, c.b}) <= 1;
    error.color = largest_difference(made.rgb, c);
    for (std::size_t i = 0; i < patch.reflectance.size(); ++i) {
      const double difference = std::abs(made.values[4 + 2 * i] - patch.reflectance[i]);  // 380 nm is band 4
      error.rms += difference * difference / static_cast<double>(patch.reflectance.size());
      error.max = std::max(error.max, difference);
    }
    error.rms = std::sqrt(error.rms);
    errors.push_back(error);
  }
  return errors;
}

std::string patches_svg() {
  constexpr double width = 980, height = 590;
  std::string svg =
      svg_element("text", {{"x", 10}, {"y", 16}},
                  "reflectance 0–1 over 380–780 nm: measured black, Jakob–Hanika blue, Matrix-R orange") +
      "\n";
  std::size_t i = 0;
  for (const ColorCheckerPatch& patch : color_checker()) {
    const double x = 10 + 160 * static_cast<double>(i % 6), y = 44 + 138 * static_cast<double>(i / 6);
    ++i;
    svg += svg_element(
               "rect",
               {{"x", x}, {"y", y}, {"width", 140}, {"height", 100}, {"fill", "none"}, {"stroke", "#bbb"}}) +
           "\n" + svg_element("text", {{"x", x}, {"y", y - 4}}, patch.name) + "\n";
    const RGB c = reflected_rgb(Spectrum{measured(patch)});
    svg += polyline({patch.reflectance.begin(), patch.reflectance.end()}, 380, 10, x, y,
                    {{"stroke", "black"}, {"stroke-width", 1.6}});
    svg += polyline(make_reflectance(UpsamplingMethod::jakob_hanika, c).values, 360, 5, x, y,
                    {{"stroke", "#2060c0"}});
    svg += polyline(make_reflectance(UpsamplingMethod::matrix_r, c).values, 360, 5, x, y,
                    {{"stroke", "#e07000"}});
  }
  return svg_picture({{"width", width}, {"height", height}}, width, height, 10, svg);
}

}  // namespace vitrail
