// SPDX-License-Identifier: Apache-2.0
// A curve plot has curves over two linear axes, as SVG that stands in a page.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vitrail {

struct Curve {
  std::string name, color;
  bool dashed = false;
  std::vector<std::pair<double, double>> points;
};

struct PlotAxis {
  std::string name;
  double low = 0, high = 1, step = 0.2;  // a line with its number at each step
};

// Returns the plot. The names of the curves stand below, beside a piece of their line.
std::string curve_plot(const PlotAxis& x, const PlotAxis& y, const std::vector<Curve>& curves);

// Returns the nth curve's colour. People who do not see red or green tell these colours apart, too.
std::string curve_color(std::size_t n);

}  // namespace vitrail
