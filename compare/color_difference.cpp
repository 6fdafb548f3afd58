// SPDX-License-Identifier: Apache-2.0
#include "compare/color_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "compare/metrics.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

constexpr double turn = 360;

double cos_degrees(double angle) { return std::cos(angle * std::numbers::pi / 180); }
double sin_degrees(double angle) { return std::sin(angle * std::numbers::pi / 180); }

double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double h = std::atan2(b, a) * 180 / std::numbers::pi;
  return h < 0 ? h + turn : h;
}

// v⁷/(v⁷ + 25⁷)
double of_chroma(double v) {
  const double seventh = std::pow(v, 7);
  return std::sqrt(seventh / (seventh + 6103515625.0));
}

}  // namespace

double ciede2000(CieLab first, CieLab second) {
  const double mean_chroma = (std::hypot(first.a, first.b) + std::hypot(second.a, second.b)) / 2;
  const double stretch = 1 + 0.5 * (1 - of_chroma(mean_chroma));
  const double a1 = stretch * first.a, a2 = stretch * second.a;
  const double c1 = std::hypot(a1, first.b), c2 = std::hypot(a2, second.b);
  const double h1 = hue(a1, first.b), h2 = hue(a2, second.b);
  const bool grey = c1 * c2 == 0;

  double hue_step = grey ? 0 : h2 - h1;
  if (hue_step > turn / 2) hue_step -= turn;
  if (hue_step < -turn / 2) hue_step += turn;
  const double dl = second.l - first.l, dc = c2 - c1, dh = 2 * std::sqrt(c1 * c2) * sin_degrees(hue_step / 2);

  double h = h1 + h2;
  if (!grey) {
    if (std::abs(h1 - h2) > turn / 2) h += h < turn ? turn : -turn;
    h /= 2;
  }
  const double l = (first.l + second.l) / 2, c = (c1 + c2) / 2;
  const double t = 1 - 0.17 * cos_degrees(h - 30) + 0.24 * cos_degrees(2 * h) +
                   0.32 * cos_degrees(3 * h + 6) - 0.20 * cos_degrees(4 * h - 63);
  const double off = (l - 50) * (l - 50);
  const double sl = 1 + 0.015 * off / std::sqrt(20 + off), sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
  const double blue = (h - 275) / 25;
  const double rotation = -sin_degrees(60 * std::exp(-blue * blue)) * 2 * of_chroma(c);
  const double x = dl / sl, y = dc / sc, z = dh / sh;
  return std::sqrt(std::max(0.0, x * x + y * y + z * z + rotation * y * z));
}

namespace {

double of_cube(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

CieLab shown(const float* pixel, double white) {
  const auto channel = [&](int c) { return std::clamp(static_cast<double>(pixel[c]) / white, 0.0, 1.0); };
  static const XYZ w = srgb_to_xyz({1, 1, 1});
  const XYZ v = srgb_to_xyz({channel(0), channel(1), channel(2)});
  const double x = of_cube(v.x / w.x), y = of_cube(v.y / w.y), z = of_cube(v.z / w.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double luminance(const float* v) {
  return srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}).y;
}

}  // namespace

std::vector<double> ciede2000_map(const Image& image, const Image& reference, double white) {
  require_same_size(image, reference);
  std::vector<double> map(image.pixels(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t p = 0; p < map.size(); ++p) {
    const float *a = &image.values[3 * p], *b = &reference.values[3 * p];
    if (std::isfinite(a[0] + a[1] + a[2]) && std::isfinite(b[0] + b[1] + b[2]))
      map[p] = ciede2000(shown(a, white), shown(b, white));
  }
  return map;
}

namespace {

std::vector<double> finite_luminances(const Image& image) {
  std::vector<double> values;
  for (std::size_t p = 0; p < image.pixels(); ++p)
    if (const double y = luminance(&image.values[3 * p]); std::isfinite(y)) values.push_back(y);
  return values;
}

}  // namespace

double mean_luminance(const Image& image) {
  const double mean = mean_of_valid(finite_luminances(image));
  return mean > 0 ? mean : 1;
}

double bright_luminance(const Image& image) {
  std::vector<double> values = finite_luminances(image);
  if (values.empty()) return 1;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at > 0 ? *at : 1;
}

}  // namespace vitrail
