// SPDX-License-Identifier: Apache-2.0
#include "cli/glazing/curve_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/common/svg.h"
#include "compare/web_page.h"

namespace vitrail {

namespace {

constexpr double width = 680, height = 320, left = 50, right = 15, top = 12, bottom = 48, line_height = 20;

double across(const PlotAxis& x, double value) {
  return left + (value - x.low) / (x.high - x.low) * (width - left - right);
}
double down(const PlotAxis& y, double value) {
  return height - bottom - (value - y.low) / (y.high - y.low) * (height - top - bottom);
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return svg_element(
             "text",
             {{"x", fmt::format("{:.1f}", x)}, {"y", fmt::format("{:.1f}", y)}, {"text-anchor", anchor}},
             escaped(text)) +
         "\n";
}

std::string path(const std::string& d, const std::string& color, double width_of_line, bool dashed) {
  std::vector<SvgAttribute> attributes{
      {"d", d}, {"fill", "none"}, {"stroke", color}, {"stroke-width", width_of_line}};
  if (dashed) attributes.emplace_back("stroke-dasharray", "5 4");
  return svg_element("path", attributes) + "\n";
}

std::string grid(const PlotAxis& x, const PlotAxis& y) {
  std::string lines;
  constexpr double rounding = 1e-9;
  for (double at = x.low; at <= x.high + rounding; at += x.step) {
    lines += path(fmt::format("M{:.1f} {}V{}", across(x, at), top, height - bottom), "#ddd", 1, false);
    lines += text_at(across(x, at), height - bottom + 16, "middle", fmt::format("{:g}", at));
  }
  for (double at = y.low; at <= y.high + rounding; at += y.step) {
    lines += path(fmt::format("M{} {:.1f}H{}", left, down(y, at), width - right), "#ddd", 1, false);
    lines += text_at(left - 6, down(y, at) + 4, "end", fmt::format("{:g}", at));
  }
  return lines + text_at((left + width - right) / 2, height - 12, "middle", x.name) +
         svg_element(
             "text",
             {{"x", 0},
              {"y", 0},
              {"text-anchor", "middle"},
              {"transform", fmt::format("translate(13,{}) rotate(-90)", (top + height - bottom) / 2)}},
             escaped(y.name)) +
         "\n";
}

}  // namespace

std::string curve_color(std::size_t n) {
  constexpr std::array colors{"#1b6f8a", "#d1603d", "#7a4988", "#b58900", "#3f8f4f", "#555555"};
  return colors[n % colors.size()];
}

std::string curve_plot(const PlotAxis& x, const PlotAxis& y, const std::vector<Curve>& curves) {
  std::string content = grid(x, y);
  double row = height;
  for (const Curve& curve : curves) {
    std::string d;
    for (const auto& [at, value] : curve.points)
      if (at >= x.low && at <= x.high)
        d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", across(x, at),
                         down(y, std::clamp(value, y.low, y.high)));
    if (!d.empty()) content += path(d, curve.color, 2, curve.dashed);
    content += path(fmt::format("M{} {}h28", left, row + 4), curve.color, 2, curve.dashed) +
               text_at(left + 36, row + 8, "start", curve.name);
    row += line_height;
  }
  const double whole = row + 4;
  return svg_picture(
      {{"viewBox", fmt::format("0 0 {} {}", width, whole)}, {"width", width}, {"height", whole}}, width,
      whole, 12, content);
}

}  // namespace vitrail
