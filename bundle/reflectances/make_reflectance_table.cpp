// SPDX-License-Identifier: Apache-2.0
// make-reflectance-table FILE: fits the vertices of the table, compares each cell with fits, and writes them
// as they lie in memory. Runs while the project is built.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <vector>

#include "bundle/reflectances/reflectance_chart.h"
#include "bundle/reflectances/sigmoid_newton.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

using Chart = ReflectanceChart;
using Vertex = ReflectanceVertex;
using Place = ReflectancePlace;

Column3 column(Float4 x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

// The greatest |ΔS|, at every tenth nanometre.
double difference(const Column3& a, const Column3& b) {
  double greatest = 0;
  for (double lambda = lambda_min_nm; lambda <= lambda_max_nm; lambda += 10) {
    const double t = 2 * (lambda - lambda_min_nm) / (lambda_max_nm - lambda_min_nm) - 1;
    const auto s = [t](const Column3& x) {
      const double v = t * (t - 1) / 2 * x[0] + (1 - t * t) * x[1] + t * (t + 1) / 2 * x[2];
      return 0.5 + 0.5 * v / std::sqrt(1 + v * v);
    };
    const double here = std::abs(s(a) - s(b));
    if (!(here <= greatest)) greatest = here;  // also what is not a number
  }
  return greatest;
}

// The colour at coordinates in units of cells.
RGB color_at(int chart, const Column3& at) {
  const double w = Chart::first_w + at[0] * Chart::cell_w, r = w / (1 - w), alpha = r * r / (1 + r * r);
  const double second = at[1] * Chart::cell_root, third = at[2] * Chart::cell_root;
  const std::array<double, 3> turned{alpha, alpha * second * second, alpha * third * third};
  const auto component = [&](int k) { return turned[static_cast<std::size_t>((k - chart + 3) % 3)]; };
  return {component(0), component(1), component(2)};
}

// √(α(1 − α)).
double scale_at(const Column3& at) {
  const double w = Chart::first_w + at[0] * Chart::cell_w, r = w / (1 - w);
  return r / (1 + r * r);
}

Column3 column(const SigmoidNodes& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

// From a start if that is near enough.
Column3 fitted(RGB color, const std::optional<Column3>& start) {
  const XYZ xyz = srgb_to_xyz(color);
  if (start)
    if (const auto nodes = finely_refined_sigmoid(*start, {xyz.x, xyz.y, xyz.z})) return column(*nodes);
  return column(nodes_of(reflectance_from_rgb(color)));
}

Vertex fitted_vertex(int chart, const Column3& at, const std::optional<Column3>& start) {
  const Column3 x = fitted(color_at(chart, at), start);
  const LinearisedColor there = linearised_color(x);
  const double w = Chart::first_w + at[0] * Chart::cell_w, r = w / (1 - w), root = 1 + r * r,
               alpha = r * r / root;
  const double scale = scale_at(at);
  const double alpha_by_cell = Chart::cell_w * 2 * r * (1 + r) * (1 + r) / (root * root);
  const double scale_by_cell = (1 - 2 * alpha) / (2 * scale) * alpha_by_cell;
  // What a cell's width along each coordinate does to the colour.
  const auto turned = [chart](const Column3& c) {
    const auto component = [&](int k) { return c[static_cast<std::size_t>((k - chart + 3) % 3)]; };
    const XYZ xyz = srgb_to_xyz({component(0), component(1), component(2)});
    return Column3{xyz.x, xyz.y, xyz.z};
  };
  const double second = at[1] * Chart::cell_root, third = at[2] * Chart::cell_root;
  const std::array<Column3, 3> changes{
      turned({alpha_by_cell, alpha_by_cell * second * second, alpha_by_cell * third * third}),
      turned({0, alpha * 2 * second * Chart::cell_root, 0}),
      turned({0, 0, alpha * 2 * third * Chart::cell_root})};
  Vertex vertex;
  for (std::size_t k = 0; k < 3; ++k) vertex.value[k] = static_cast<float>(scale * x[k]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Column3 slope = solve(there.jacobian, changes[axis]);
    for (std::size_t k = 0; k < 3; ++k)
      vertex.slopes[axis][k] = static_cast<float>(scale * slope[k] + (axis == 0 ? scale_by_cell * x[k] : 0));
  }
  return vertex;
}

std::size_t index_of(int chart, const std::array<int, 3>& at) { return Place{chart, at}.index(); }

// The vertex from whose slopes a fit begins: every fourth along each coordinate.
std::array<int, 3> start_of(const std::array<int, 3>& at) {
  return {(at[0] + 2) / 4 * 4, (at[1] + 2) / 4 * 4, (at[2] + 2) / 4 * 4};
}

std::optional<Column3> start(const std::vector<Vertex>& vertices, int chart, const std::array<int, 3>& at) {
  const std::array<int, 3> near = start_of(at);
  if (near == at) return std::nullopt;
  const Vertex& v = vertices[index_of(chart, near)];
  Column3 here, x = column(v.value);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    here[axis] = at[axis];
    for (std::size_t k = 0; k < 3; ++k) x[k] += (at[axis] - near[axis]) * column(v.slopes[axis])[k];
  }
  for (double& v_k : x) v_k /= scale_at(here);
  return x;
}

bool is_close(const std::vector<Vertex>& vertices, const Place& place, const std::array<float, 3>& part) {
  Column3 at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = place.cell[k] + static_cast<double>(part[k]);
  const RGB color = color_at(place.chart, at);
  Place there = place;
  there.part = part, there.unscale = static_cast<float>(1 / scale_at(at));
  const Column3 x = column(interpolated(&vertices[place.index()], there));
  const XYZ xyz = srgb_to_xyz(color);
  const auto fit = refined_sigmoid(x, {xyz.x, xyz.y, xyz.z});
  return fit && difference(x, column(*fit)) < Chart::trusted_difference;
}

bool is_trusted(const std::vector<Vertex>& vertices, const Place& place) {
  constexpr std::array<std::array<float, 3>, 5> places{
      {{0.5f, 0.5f, 0.5f}, {0.2f, 0.2f, 0.2f}, {0.2f, 0.8f, 0.8f}, {0.8f, 0.2f, 0.8f}, {0.8f, 0.8f, 0.2f}}};
  return std::ranges::all_of(places, [&](const auto& part) { return is_close(vertices, place, part); });
}

// f(chart, place) with each of these places, on all cores.
template <typename F>
void for_each_place(int alphas, int ratios, const F& f) {
  tbb::parallel_for(0, Chart::count * alphas, [&](int row) {
    for (int b = 0; b < ratios; ++b)
      for (int c = 0; c < ratios; ++c) f(row / alphas, std::array<int, 3>{row % alphas, b, c});
  });
}

std::vector<Vertex> reflectance_vertices() {
  std::vector<Vertex> vertices(Chart::vertex_count);
  const auto fit_those = [&](bool starts) {
    for_each_place(Chart::alpha_cells + 1, Chart::ratio_cells + 1, [&](int chart, const auto& at) {
      if ((start_of(at) == at) == starts)
        vertices[index_of(chart, at)] =
            fitted_vertex(chart, {at[0] + 0.0, at[1] + 0.0, at[2] + 0.0}, start(vertices, chart, at));
    });
  };
  fit_those(true);
  fit_those(false);
  for_each_place(Chart::alpha_cells, Chart::ratio_cells, [&](int chart, const auto& at) {
    const Place place{chart, at};
    vertices[place.index()].value[3] = is_trusted(vertices, place) ? 1.0f : 0.0f;
  });
  return vertices;
}

}  // namespace

}  // namespace vitrail

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make-reflectance-table FILE\n", stderr);
    return EXIT_FAILURE;
  }
  const auto vertices = vitrail::reflectance_vertices();
  std::ofstream file(argv[1], std::ios::binary);
  file.write(reinterpret_cast<const char*>(vertices.data()),
             static_cast<std::streamsize>(vertices.size() * sizeof(vertices.front())));
  if (!file.flush()) {
    std::fprintf(stderr, "cannot write %s\n", argv[1]);
    return EXIT_FAILURE;
  }
}
