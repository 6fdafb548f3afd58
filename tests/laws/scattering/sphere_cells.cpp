// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/scattering/sphere_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/geometry/pi.h"

namespace vitrail::laws {

namespace {

constexpr std::size_t samples_in_cell = 4;
constexpr int deepest_cell = 80, deepest_integral = 7;
constexpr double absolute_tolerance = 2e-7, relative_tolerance = 1e-3;  // of one cell's integral

// Gauss and Legendre's rule with four nodes, over [0, 1].
constexpr std::array<double, 4> node = {0.069431844202973712, 0.330009478207571868, 0.669990521792428132,
                                        0.930568155797026288};
constexpr std::array<double, 4> weight = {0.173927422568726929, 0.326072577431273071, 0.326072577431273071,
                                          0.173927422568726929};

// Onto [−1, 1]²; the pole is the centre. 2·π of solid angle over an area of 4.
Point2d to_square(Vector3d d) {
  const double s = std::hypot(d.x, d.y);
  const double r = s / std::sqrt(1 + std::abs(d.z));
  if (s == 0) return {};
  const double ax = std::abs(d.x), ay = std::abs(d.y);
  const double turn = 4 / pi * std::atan2(std::min(ax, ay), std::max(ax, ay));
  const Point2d p = ax > ay ? Point2d{r, r * turn} : Point2d{r * turn, r};
  return {std::copysign(p.x, d.x), std::copysign(p.y, d.y)};
}

Vector3d to_direction(double x, double y, double side) {
  const double r = std::max(std::abs(x), std::abs(y));
  if (r == 0) return {0, 0, side};
  const double turn = pi / 4 * std::min(std::abs(x), std::abs(y)) / r;
  const double s = r * std::sqrt(2 - r * r);
  const double major = s * std::cos(turn), minor = s * std::sin(turn);
  const bool along_x = std::abs(x) > std::abs(y);
  return {std::copysign(along_x ? major : minor, x), std::copysign(along_x ? minor : major, y),
          side * (1 - r * r)};
}

}  // namespace

SphereCells::SphereCells(const std::vector<Vector3d>& samples) {
  nodes_.emplace_back();  // which side of the surface
  std::vector<Point2d> below, above;
  for (Vector3d s : samples) (s.z < 0 ? below : above).push_back(to_square(s));
  const std::size_t lower = build({-1, -1, 1, -1, 1}, std::move(below), 0);
  const std::size_t upper = build({1, -1, 1, -1, 1}, std::move(above), 0);
  nodes_[0].below = lower;
  nodes_[0].above = upper;
}

std::size_t SphereCells::build(const Box& box, std::vector<Point2d> points, int depth) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  if (points.size() <= samples_in_cell || depth == deepest_cell) {
    nodes_[self].below = boxes_.size();
    boxes_.push_back(box);
    return self;
  }
  // Halved across the axis along which the samples are closer together.
  const auto [left, right] =
      std::minmax_element(points.begin(), points.end(), [](Point2d a, Point2d b) { return a.x < b.x; });
  const auto [bottom, top] =
      std::minmax_element(points.begin(), points.end(), [](Point2d a, Point2d b) { return a.y < b.y; });
  const double spread_x = (right->x - left->x) / (box.x1 - box.x0);
  const double spread_y = (top->y - bottom->y) / (box.y1 - box.y0);
  const int axis = spread_x < spread_y ? 0 : 1;
  const double at = axis == 0 ? (box.x0 + box.x1) / 2 : (box.y0 + box.y1) / 2;
  Box low = box, high = box;
  (axis == 0 ? low.x1 : low.y1) = at;
  (axis == 0 ? high.x0 : high.y0) = at;
  const auto middle =
      std::partition(points.begin(), points.end(), [&](Point2d p) { return (axis == 0 ? p.x : p.y) < at; });
  std::vector<Point2d> upper(middle, points.end());
  points.erase(middle, points.end());
  const std::size_t below = build(low, std::move(points), depth + 1);
  const std::size_t above = build(high, std::move(upper), depth + 1);
  nodes_[self] = {axis, at, below, above};
  return self;
}

std::size_t SphereCells::cell_of(Vector3d d) const {
  const Point2d p = to_square(d);
  const Node* n = &nodes_[d.z < 0 ? nodes_[0].below : nodes_[0].above];
  while (n->axis >= 0) n = &nodes_[(n->axis == 0 ? p.x : p.y) < n->at ? n->below : n->above];
  return n->below;
}

double SphereCells::gauss(const std::function<double(Vector3d)>& f, const Box& box) const {
  const double dx = box.x1 - box.x0, dy = box.y1 - box.y0;
  double sum = 0;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (std::size_t j = 0; j < node.size(); ++j)
      sum += weight[i] * weight[j] * f(to_direction(box.x0 + dx * node[i], box.y0 + dy * node[j], box.side));
  return sum * dx * dy * (pi / 2);
}

double SphereCells::adaptive(const std::function<double(Vector3d)>& f, const Box& box, double coarse,
                             int depth) const {
  const double x = (box.x0 + box.x1) / 2, y = (box.y0 + box.y1) / 2;
  const std::array<Box, 4> quarters = {
      Box{box.side, box.x0, x, box.y0, y}, Box{box.side, x, box.x1, box.y0, y},
      Box{box.side, box.x0, x, y, box.y1}, Box{box.side, x, box.x1, y, box.y1}};
  std::array<double, 4> part{};
  double fine = 0;
  for (std::size_t i = 0; i < 4; ++i) fine += part[i] = gauss(f, quarters[i]);
  if (depth == 0 || std::abs(fine - coarse) <= absolute_tolerance + relative_tolerance * std::abs(fine))
    return fine;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += adaptive(f, quarters[i], part[i], depth - 1);
  return sum;
}

std::vector<double> SphereCells::integrate(const std::function<double(Vector3d)>& f) const {
  std::vector<double> result;
  result.reserve(boxes_.size());
  for (const Box& box : boxes_) result.push_back(adaptive(f, box, gauss(f, box), deepest_integral));
  return result;
}

}  // namespace vitrail::laws
