// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/reflectance_table.h"

#include <algorithm>
#include <cmath>

#include "bundle/reflectances/reflectance_chart.h"

// What make_reflectance_table.cpp wrote.
extern "C" const vitrail::ReflectanceVertex vitrail_reflectance_table[];

namespace vitrail {

namespace {

using Chart = ReflectanceChart;

using Floats = std::array<float, reflectance_batch>;
using Ints = std::array<int, reflectance_batch>;

// Where colours are in their charts. Plain loops over arrays, which the compiler vectorises.
struct Places {
  Ints chart, bright;  // bright: 1 − S has the colour 1 − c, and −x
  std::array<Ints, 3> cell;
  std::array<Floats, 3> part;
  Floats unscale;
  Ints inside;

  ReflectancePlace operator[](std::size_t l) const {
    return {chart[l], {cell[0][l], cell[1][l], cell[2][l]}, {part[0][l], part[1][l], part[2][l]}, unscale[l]};
  }
};

float middle(float v, float least, float most) { return v > least ? (v < most ? v : most) : least; }

// What is not within the charts has some place too.
void find_places(std::array<Floats, 3>& c, Places& places) {
  constexpr std::size_t count = reflectance_batch;
  const auto first_w = static_cast<float>(Chart::first_w), by_cell_w = static_cast<float>(1 / Chart::cell_w);
  for (std::size_t l = 0; l < count; ++l) {
    const float r = c[0][l], g = c[1][l], b = c[2][l];
    const int bright = r + g + b > 1.5f ? 1 : 0;
    const int grey = (r == g ? 1 : 0) & (g == b ? 1 : 0);
    places.bright[l] = bright;
    const float x = bright ? 1 - r : r, y = bright ? 1 - g : g, z = bright ? 1 - b : b;
    const float least = x < y ? (x < z ? x : z) : (y < z ? y : z);
    const float most = x > y ? (x > z ? x : z) : (y > z ? y : z);
    const int ordered = (x >= 0 ? 1 : 0) & (y >= 0 ? 1 : 0) & (z >= 0 ? 1 : 0);  // no NaN either
    places.inside[l] = (1 - grey) & ordered & (least >= 0 ? 1 : 0) & (most <= 1 ? 1 : 0) &
                       (most >= Chart::least_alpha ? 1 : 0);
    c[0][l] = x, c[1][l] = y, c[2][l] = z;
  }
  std::array<Floats, 3> at;
  for (std::size_t l = 0; l < count; ++l) {
    const float r = c[0][l], g = c[1][l], b = c[2][l];
    const int red = (r >= g ? 1 : 0) & (r >= b ? 1 : 0), green = g >= b ? 1 : 0;
    const float first = green ? g : b, second = green ? b : r, third = green ? r : g;
    places.chart[l] = (1 - red) * (2 - green);
    at[0][l] = red ? r : first;
    at[1][l] = red ? g : second;
    at[2][l] = red ? b : third;
  }
  for (std::size_t l = 0; l < count; ++l) {
    const float alpha = middle(at[0][l], Chart::least_alpha, Chart::greatest_alpha), below = 1 - alpha;
    const float root = std::sqrt(alpha / below), each = 1 / middle(at[0][l], Chart::least_alpha, 1);
    places.unscale[l] = 1 / (root * below);
    at[0][l] = (root / (1 + root) - first_w) * by_cell_w;
    at[1][l] = std::sqrt(middle(at[1][l] * each, 0, 1)) * Chart::ratio_cells;
    at[2][l] = std::sqrt(middle(at[2][l] * each, 0, 1)) * Chart::ratio_cells;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const int cells = k == 0 ? Chart::alpha_cells : Chart::ratio_cells;
    for (std::size_t l = 0; l < count; ++l) {
      const float in_cells = middle(at[k][l], 0, static_cast<float>(cells));
      const int cell = static_cast<int>(in_cells);
      places.cell[k][l] = cell < cells ? cell : cells - 1;
      places.part[k][l] = in_cells - static_cast<float>(places.cell[k][l]);
    }
  }
}

const ReflectanceVertex* first_vertex(const ReflectancePlace& place) {
  return vitrail_reflectance_table + place.index();
}

}  // namespace

void tabulated_reflectances(std::span<const std::array<float, 3>> colors,
                            std::span<std::optional<SigmoidNodes>> nodes) {
  std::array<Floats, 3> component{};
  for (std::size_t l = 0; l < colors.size(); ++l)
    for (std::size_t k = 0; k < 3; ++k) component[k][l] = colors[l][k];
  Places places;
  find_places(component, places);
  // The table is larger than the caches that are near. (Not in a function: GCC takes calls for nothing that
  // only prefetch.)
  for (std::size_t l = 0; l < colors.size(); ++l)
    if (places.inside[l])
      for (const int a : {0, Chart::along_alpha})
        for (const int b : {0, Chart::along_ratio})
          for (const int c : {0, 1}) __builtin_prefetch(first_vertex(places[l]) + a + b + c);
  for (std::size_t l = 0; l < colors.size(); ++l) {
    nodes[l].reset();
    if (!places.inside[l]) continue;
    const ReflectancePlace place = places[l];
    const ReflectanceVertex* const first = first_vertex(place);
    if (first->value[3] != 1) continue;
    const Float4 x = interpolated(first, place);
    const float sign = places.bright[l] ? -1.0f : 1.0f;
    nodes[l] = {sign * x[0], sign * x[1], sign * x[2]};
  }
}

std::optional<SigmoidNodes> tabulated_reflectance(const std::array<float, 3>& color) {
  std::optional<SigmoidNodes> nodes;
  tabulated_reflectances({&color, 1}, {&nodes, 1});
  return nodes;
}

}  // namespace vitrail
