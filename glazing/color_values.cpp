// SPDX-License-Identifier: Apache-2.0
#include "glazing/color_values.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "glazing/standard_tables.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

struct Point {
  double x = 0, y = 0;
};

Point chromaticity(double x, double y, double z) { return {x / (x + y + z), y / (x + y + z)}; }
double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

struct LocusPoint {
  double nm = 0;
  Point at;
};

// Each 5 nm from 360 to 830 nm.
std::vector<LocusPoint> locus_of(Observer observer) {
  std::vector<LocusPoint> locus;
  for (std::size_t i = 0; i < 95; ++i) {
    const double nm = 360 + 5 * static_cast<double>(i);
    if (observer == Observer::cie_1964) {
      const auto& v = cie_1964_5nm()[i];
      locus.push_back({nm, chromaticity(v[0], v[1], v[2])});
    } else {
      const auto& v = cie_1931()[5 * i];
      locus.push_back({nm, chromaticity(v[0], v[1], v[2])});
    }
  }
  return locus;
}

// Where the ray from `origin` through `through` crosses the segment a–b: the part of the segment in [0, 1].
std::optional<double> crossing(Point origin, Point through, Point a, Point b) {
  const double dx = through.x - origin.x, dy = through.y - origin.y, ex = b.x - a.x, ey = b.y - a.y;
  const double determinant = dx * ey - dy * ex;
  if (std::abs(determinant) < 1e-12) return {};
  const double ax = a.x - origin.x, ay = a.y - origin.y;
  const double along_ray = (ax * ey - ay * ex) / determinant,
               along_segment = (ax * dy - ay * dx) / determinant;
  if (along_ray <= 0 || along_segment < 0 || along_segment > 1) return {};
  return along_segment;
}

std::optional<LocusPoint> on_locus(const std::vector<LocusPoint>& locus, Point origin, Point through) {
  for (std::size_t i = 0; i + 1 < locus.size(); ++i) {
    const LocusPoint &a = locus[i], &b = locus[i + 1];
    if (const auto s = crossing(origin, through, a.at, b.at))
      return LocusPoint{a.nm + *s * (b.nm - a.nm),
                        {a.at.x + *s * (b.at.x - a.at.x), a.at.y + *s * (b.at.y - a.at.y)}};
  }
  return {};
}

void take_dominant(ColorValues& color, Point white, Observer observer) {
  const auto& [x, y, z] = color.xyz;
  if (x + y + z < 1e-10) return;
  const Point at = chromaticity(x, y, z);
  if (distance(at, white) < 1e-9) return;
  const auto locus = locus_of(observer);
  auto end = on_locus(locus, white, at);
  if (!end) {
    const LocusPoint &blue = locus.front(), &red = locus.back();
    const auto s = crossing(white, at, blue.at, red.at);
    if (!s) return;
    end = {*s < 0.5 ? blue.nm : red.nm,
           {blue.at.x + *s * (red.at.x - blue.at.x), blue.at.y + *s * (red.at.y - blue.at.y)}};
    if (const auto behind = on_locus(locus, at, white)) color.complementary_nm = behind->nm;
  }
  color.dominant_nm = end->nm;
  color.purity = distance(at, white) / distance(end->at, white);
}

double lab_root(double t) { return t > 216.0 / 24389 ? std::cbrt(t) : 841.0 / 108 * t + 4.0 / 29; }

std::array<int, 3> display_rgb(const std::array<double, 3>& xyz) {
  // The display's white of 80 cd/m² stands for 80, its black of 0.2 for none; XYZ of the black have D65's
  // ratios.
  constexpr double range = 80 - 0.2;
  const RGB c = xyz_to_srgb({(xyz[0] - 0.1901) / range, (xyz[1] - 0.2) / range, (xyz[2] - 0.2178) / range});
  std::array<int, 3> result{};
  const std::array linear{c.r, c.g, c.b};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = static_cast<int>(std::lround(255 * srgb_encode(std::clamp(linear[i], 0.0, 1.0))));
  return result;
}

}  // namespace

ColorValues color_values(const std::array<double, 3>& relative, const std::array<double, 3>& white,
                         Observer observer) {
  ColorValues color;
  std::array<double, 3> roots{};
  for (std::size_t i = 0; i < 3; ++i) {
    color.xyz[i] = 100 * relative[i] * white[i];
    roots[i] = lab_root(relative[i]);
  }
  color.lab = {116 * roots[1] - 16, 500 * (roots[0] - roots[1]), 200 * (roots[1] - roots[2])};
  color.rgb = display_rgb(color.xyz);
  take_dominant(color, chromaticity(white[0], white[1], white[2]), observer);
  return color;
}

}  // namespace vitrail
