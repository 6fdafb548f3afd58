// SPDX-License-Identifier: Apache-2.0
#include "cli/plan/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

constexpr double width = 640, height = 400, left = 70, right = 20, top = 20, bottom = 50;

// From decades to pixels.
struct Axis {
  double low, high, from, to;
  double operator()(double value) const {
    return from + (std::log10(value) - low) / std::max(high - low, 1e-9) * (to - from);
  }
};

Axis axis_of(double least, double most, double from, double to) {
  return {std::floor(std::log10(least)), std::ceil(std::log10(most) + 1e-9), from, to};
}

}  // namespace

std::string plan_svg(const std::vector<PlanPoint>& points) {
  double least = 1e300, most = 0;
  for (const PlanPoint& p : points) {
    least =
        std::min({least, p.result.seconds, points.front().result.seconds * points.front().ranks / p.ranks});
    most = std::max(most, p.result.seconds);
  }
  const Axis x = axis_of(points.front().ranks, points.back().ranks, left, width - right),
             y = axis_of(least, most, height - bottom, top);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      width, height);
  for (double d = x.low; d <= x.high; ++d)
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">{4:g}</text>\n",
        x(std::pow(10, d)), top, height - bottom, height - bottom + 16, std::pow(10, d));
  for (double d = y.low; d <= y.high; ++d)
    svg += fmt::format(
        "<path d=\"M{1} {0:.1f}H{2}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:g} s</text>\n",
        y(std::pow(10, d)), left, width - right, left - 6, y(std::pow(10, d)) + 4, std::pow(10, d));
  std::string line, ideal;
  for (const PlanPoint& p : points) {
    const char* step = line.empty() ? "M" : "L";
    line += fmt::format("{}{:.1f} {:.1f}", step, x(p.ranks), y(p.result.seconds));
    ideal += fmt::format("{}{:.1f} {:.1f}", step, x(p.ranks),
                         y(points.front().result.seconds * points.front().ranks / p.ranks));
    svg += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"3.5\" fill=\"#1b6f8a\"/><text x=\"{0:.1f}\" y=\"{2:.1f}\" "
        "text-anchor=\"middle\" fill=\"#1b6f8a\">{3:.0f} %</text>\n",
        x(p.ranks), y(p.result.seconds), y(p.result.seconds) - 9, 100 * p.result.efficiency);
  }
  svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#8f8f8f\" stroke-dasharray=\"4 4\"/>\n", ideal);
  svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#1b6f8a\" stroke-width=\"2\"/>\n", line);
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">ranks (labels: efficiency; dashed: perfect "
      "scaling)</text>\n</svg>\n",
      (left + width - right) / 2, height - 12);
  return svg;
}

}  // namespace vitrail
