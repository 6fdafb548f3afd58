// SPDX-License-Identifier: Apache-2.0
#include "cli/plan/plan_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/common/svg.h"

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

std::string tenths(double value) { return fmt::format("{:.1f}", value); }

const std::string grid = "#ddd", measured = "#1b6f8a", perfect = "#8f8f8f";

// A line at each decade, with its number.
std::string grid_lines(const Axis& x, const Axis& y) {
  std::string lines;
  for (double d = x.low; d <= x.high; ++d) {
    const std::string at = tenths(x(std::pow(10, d)));
    lines +=
        svg_element("path", {{"d", fmt::format("M{} {}V{}", at, top, height - bottom)}, {"stroke", grid}}) +
        svg_element("text", {{"x", at}, {"y", height - bottom + 16}, {"text-anchor", "middle"}},
                    fmt::format("{:g}", std::pow(10, d))) +
        "\n";
  }
  for (double d = y.low; d <= y.high; ++d) {
    const double at = y(std::pow(10, d));
    lines += svg_element("path",
                         {{"d", fmt::format("M{} {:.1f}H{}", left, at, width - right)}, {"stroke", grid}}) +
             svg_element("text", {{"x", left - 6}, {"y", tenths(at + 4)}, {"text-anchor", "end"}},
                         fmt::format("{:g} s", std::pow(10, d))) +
             "\n";
  }
  return lines;
}

// A point with its efficiency above it.
std::string labelled_point(double x, double y, double efficiency) {
  return svg_element("circle", {{"cx", tenths(x)}, {"cy", tenths(y)}, {"r", 3.5}, {"fill", measured}}) +
         svg_element("text",
                     {{"x", tenths(x)}, {"y", tenths(y - 9)}, {"text-anchor", "middle"}, {"fill", measured}},
                     fmt::format("{:.0f} %", 100 * efficiency)) +
         "\n";
}

}  // namespace

std::string plan_svg(const std::vector<PlanPoint>& points) {
  const auto ideal_s = [&](const PlanPoint& p) {
    return points.front().result.seconds * points.front().ranks / p.ranks;
  };
  double least = 1e300, most = 0;
  for (const PlanPoint& p : points) {
    least = std::min({least, p.result.seconds, ideal_s(p)});
    most = std::max(most, p.result.seconds);
  }
  const Axis x = axis_of(points.front().ranks, points.back().ranks, left, width - right),
             y = axis_of(least, most, height - bottom, top);
  std::string svg = grid_lines(x, y), line, ideal;
  for (const PlanPoint& p : points) {
    const char* step = line.empty() ? "M" : "L";
    line += fmt::format("{}{:.1f} {:.1f}", step, x(p.ranks), y(p.result.seconds));
    ideal += fmt::format("{}{:.1f} {:.1f}", step, x(p.ranks), y(ideal_s(p)));
    svg += labelled_point(x(p.ranks), y(p.result.seconds), p.result.efficiency);
  }
  svg += svg_element("path",
                     {{"d", ideal}, {"fill", "none"}, {"stroke", perfect}, {"stroke-dasharray", "4 4"}}) +
         "\n";
  svg +=
      svg_element("path", {{"d", line}, {"fill", "none"}, {"stroke", measured}, {"stroke-width", 2}}) + "\n";
  svg +=
      svg_element("text",
                  {{"x", tenths((left + width - right) / 2)}, {"y", height - 12}, {"text-anchor", "middle"}},
                  "ranks (labels: efficiency; dashed: perfect scaling)") +
      "\n";
  return svg_picture({{"viewBox", fmt::format("0 0 {} {}", width, height)}}, width, height, 12, svg);
}

}  // namespace vitrail
