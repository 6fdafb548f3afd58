// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/reflectance_table.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <vector>

#include "partitioner/appearance/sigmoid_newton.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

// x at three wavelengths; the last is not used.
using Float4 = float __attribute__((vector_size(16)));

struct alignas(64) Vertex {
  Float4 value{};                  // √(α(1 − α))·x
  std::array<Float4, 3> slopes{};  // by the coordinates, over the width of a cell
};

enum class Trust : std::uint8_t { unknown, trusted, refused };

constexpr int alpha_cells = 24, ratio_cells = 32;
constexpr float least_alpha = 1e-5f, greatest_alpha = 1 - 1e-5f;

constexpr int along_ratio = ratio_cells + 1, along_alpha = along_ratio * along_ratio;
constexpr std::size_t vertex_count = std::size_t{3} * (alpha_cells + 1) * along_alpha;

// w of α, and back.
double warp(double alpha) {
  const double r = std::sqrt(alpha / (1 - alpha));
  return r / (1 + r);
}
const double first_w = warp(static_cast<double>(least_alpha));
const double cell_w = (warp(static_cast<double>(greatest_alpha)) - first_w) / alpha_cells;
constexpr double cell_root = 1.0 / ratio_cells;

// Where a colour is in its chart.
struct Place {
  int chart = 0;
  std::array<int, 3> cell{};
  std::array<float, 3> part{};  // of the cell, within [0,1]
  float unscale = 0;            // 1/√(α(1 − α))

  // Also of the cell's first vertex.
  std::size_t index() const {
    return static_cast<std::size_t>(
        ((chart * (alpha_cells + 1) + cell[0]) * along_ratio + cell[1]) * along_ratio + cell[2]);
  }
};

// Of four colours, which the compiler takes together: what is not within the charts has some place too.
void find_places(const std::array<Float4, 3>& c, std::array<Place, 4>& places) {
  std::array<Float4, 3> at;
  Float4 unscale;
  std::array<int, 4> charts;
  const auto middle = [](float v, float least, float most) {
    return v > least ? (v < most ? v : most) : least;
  };
  for (std::size_t l = 0; l < 4; ++l) {
    const float r = c[0][l], g = c[1][l], b = c[2][l];
    const bool red = r >= g && r >= b, green = !red && g >= b;
    charts[l] = red ? 0 : green ? 1 : 2;
    at[0][l] = red     ? r
               : green ? g
                       : b,
    at[1][l] = red     ? g
               : green ? b
                       : r,
    at[2][l] = red     ? b
               : green ? r
                       : g;
  }
  for (std::size_t l = 0; l < 4; ++l) {
    const float alpha = middle(at[0][l], least_alpha, greatest_alpha), below = 1 - alpha;
    const float root = std::sqrt(alpha / below), each = 1 / middle(at[0][l], least_alpha, 1);
    unscale[l] = 1 / (root * below);
    at[0][l] = (root / (1 + root) - static_cast<float>(first_w)) * static_cast<float>(1 / cell_w);
    at[1][l] = std::sqrt(middle(at[1][l] * each, 0, 1)) * ratio_cells;
    at[2][l] = std::sqrt(middle(at[2][l] * each, 0, 1)) * ratio_cells;
  }
  for (std::size_t l = 0; l < 4; ++l) {
    Place& place = places[l];
    place.chart = charts[l];
    place.unscale = unscale[l];
    for (std::size_t k = 0; k < 3; ++k) {
      const int cells = k == 0 ? alpha_cells : ratio_cells;
      const float in_cells = middle(at[k][l], 0, static_cast<float>(cells));
      place.cell[k] = std::min(static_cast<int>(in_cells), cells - 1);
      place.part[k] = in_cells - static_cast<float>(place.cell[k]);
    }
  }
}

// Of the vertices of a cell: by value, and by each slope. At the distance d along an axis a cubic with given
// ends is u·(1 + d·(u − d))·value + u·d·u·slope, u = 1 − d.
Float4 interpolated(const Vertex* first, const Place& place) {
  std::array<std::array<float, 2>, 3> weight, bend, lean;
  for (std::size_t k = 0; k < 3; ++k) {
    const float f = place.part[k], g = 1 - f, both = f * g;
    weight[k] = {g, f};
    bend[k] = {f * (g - f), g * (f - g)};
    lean[k] = {both, -both};
  }
  Float4 sum{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t a = corner >> 2, b = corner >> 1 & 1, c = corner & 1;
    const Vertex& v = first[a * along_alpha + b * along_ratio + c];
    const float all = weight[0][a] * weight[1][b] * weight[2][c];
    const float straight = all * (1 + bend[0][a] + bend[1][b] + bend[2][c]);
    const float s0 = all * lean[0][a], s1 = all * lean[1][b], s2 = all * lean[2][c];
    sum += v.value * straight + v.slopes[0] * s0 + (v.slopes[1] * s1 + v.slopes[2] * s2);
  }
  return sum * place.unscale;
}

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
  const double w = first_w + at[0] * cell_w, r = w / (1 - w), alpha = r * r / (1 + r * r);
  const double second = at[1] * cell_root, third = at[2] * cell_root;
  const std::array<double, 3> turned{alpha, alpha * second * second, alpha * third * third};
  const auto component = [&](int k) { return turned[static_cast<std::size_t>((k - chart + 3) % 3)]; };
  return {component(0), component(1), component(2)};
}

// √(α(1 − α)).
double scale_at(const Column3& at) {
  const double w = first_w + at[0] * cell_w, r = w / (1 - w);
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
  const double w = first_w + at[0] * cell_w, r = w / (1 - w), root = 1 + r * r, alpha = r * r / root;
  const double scale = scale_at(at);
  const double alpha_by_cell = cell_w * 2 * r * (1 + r) * (1 + r) / (root * root);
  const double scale_by_cell = (1 - 2 * alpha) / (2 * scale) * alpha_by_cell;
  // What a cell's width along each coordinate does to the colour.
  const auto turned = [chart](const Column3& c) {
    const auto component = [&](int k) { return c[static_cast<std::size_t>((k - chart + 3) % 3)]; };
    const XYZ xyz = srgb_to_xyz({component(0), component(1), component(2)});
    return Column3{xyz.x, xyz.y, xyz.z};
  };
  const double second = at[1] * cell_root, third = at[2] * cell_root;
  const std::array<Column3, 3> changes{
      turned({alpha_by_cell, alpha_by_cell * second * second, alpha_by_cell * third * third}),
      turned({0, alpha * 2 * second * cell_root, 0}), turned({0, 0, alpha * 2 * third * cell_root})};
  Vertex vertex;
  for (std::size_t k = 0; k < 3; ++k) vertex.value[k] = static_cast<float>(scale * x[k]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Column3 slope = solve(there.jacobian, changes[axis]);
    for (std::size_t k = 0; k < 3; ++k)
      vertex.slopes[axis][k] = static_cast<float>(scale * slope[k] + (axis == 0 ? scale_by_cell * x[k] : 0));
  }
  return vertex;
}

}  // namespace

struct ReflectanceTable::Charts {
  std::vector<Vertex> vertices = std::vector<Vertex>(vertex_count);
  std::vector<std::atomic<bool>> made = std::vector<std::atomic<bool>>(vertex_count);
  std::vector<std::atomic<Trust>> trust = std::vector<std::atomic<Trust>>(vertex_count);
  std::mutex mutex;

  Trust trust_in(const Place& place) {
    const Trust known = trust[place.index()].load(std::memory_order_acquire);
    return known != Trust::unknown ? known : examine(place);
  }

 private:
  // Makes the cell's vertices, and compares what they give with fits.
  Trust examine(const Place& place) {
    for (int corner = 0; corner < 8; ++corner)
      make_vertex(place.chart, {place.cell[0] + (corner >> 2), place.cell[1] + (corner >> 1 & 1),
                                place.cell[2] + (corner & 1)});
    constexpr std::array<std::array<float, 3>, 5> places{
        {{0.5f, 0.5f, 0.5f}, {0.2f, 0.2f, 0.2f}, {0.2f, 0.8f, 0.8f}, {0.8f, 0.2f, 0.8f}, {0.8f, 0.8f, 0.2f}}};
    bool close = true;
    for (std::size_t k = 0; k < places.size() && close; ++k) close = is_close(place, places[k]);
    const Trust found = close ? Trust::trusted : Trust::refused;
    trust[place.index()].store(found, std::memory_order_release);
    return found;
  }

  bool is_close(const Place& place, const std::array<float, 3>& part) const {
    Column3 at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = place.cell[k] + static_cast<double>(part[k]);
    const RGB color = color_at(place.chart, at);
    Place there;
    there.chart = place.chart, there.cell = place.cell, there.part = part;
    there.unscale = static_cast<float>(1 / scale_at(at));
    const Column3 x = column(interpolated(&vertices[place.index()], there));
    const XYZ xyz = srgb_to_xyz(color);
    const auto fit = refined_sigmoid(x, {xyz.x, xyz.y, xyz.z});
    return fit && difference(x, column(*fit)) < trusted_difference;
  }

  // Every fourth vertex is fitted from nothing, the others from the nearest of those.
  void make_vertex(int chart, const std::array<int, 3>& at) {
    const std::size_t index = Place{chart, at}.index();
    if (made[index].load(std::memory_order_acquire)) return;
    std::array<int, 3> near;
    Column3 here, away;
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = (at[k] + 2) / 4 * 4;
      here[k] = at[k], away[k] = at[k] - near[k];
    }
    std::optional<Column3> start;
    if (near != at) {
      make_vertex(chart, near);
      const Vertex& v = vertices[Place{chart, near}.index()];
      const Column3 value = column(v.value);
      start.emplace();
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = value[k];
        for (std::size_t axis = 0; axis < 3; ++axis) sum += away[axis] * column(v.slopes[axis])[k];
        (*start)[k] = sum / scale_at(here);
      }
    }
    const Vertex vertex = fitted_vertex(chart, here, start);
    const std::lock_guard lock(mutex);
    if (made[index].load(std::memory_order_relaxed)) return;
    vertices[index] = vertex;
    made[index].store(true, std::memory_order_release);
  }
};

ReflectanceTable::ReflectanceTable()
    : charts_([]() -> Charts& {
        static Charts shared;  // one for all: what it holds depends on nothing
        return shared;
      }()) {}

std::array<std::optional<SigmoidNodes>, 4> ReflectanceTable::of_four(
    const std::array<std::array<float, 3>, 4>& colors) const {
  std::array<Float4, 3> dark;
  std::array<bool, 4> bright, inside;
  for (std::size_t l = 0; l < 4; ++l) {
    const auto& c = colors[l];
    bright[l] = c[0] + c[1] + c[2] > 1.5f;  // 1 − S has the colour 1 − c, and −x
    const float r = bright[l] ? 1 - c[0] : c[0], g = bright[l] ? 1 - c[1] : c[1],
                b = bright[l] ? 1 - c[2] : c[2];
    const bool grey = c[0] == c[1] && c[1] == c[2];
    inside[l] = !grey && r >= 0 && g >= 0 && b >= 0 && r <= 1 && g <= 1 && b <= 1 &&
                (r >= least_alpha || g >= least_alpha || b >= least_alpha);
    dark[0][l] = r, dark[1][l] = g, dark[2][l] = b;
  }
  std::array<Place, 4> places;
  find_places(dark, places);
  std::array<std::optional<SigmoidNodes>, 4> nodes;
  for (std::size_t l = 0; l < 4; ++l) {
    if (!inside[l] || charts_.trust_in(places[l]) != Trust::trusted) continue;
    Float4 x = interpolated(&charts_.vertices[places[l].index()], places[l]);
    if (bright[l]) x = -x;
    nodes[l] = {x[0], x[1], x[2]};
  }
  return nodes;
}

std::optional<SigmoidNodes> ReflectanceTable::operator()(const std::array<float, 3>& color) const {
  return of_four({color, color, color, color})[0];
}

}  // namespace vitrail
