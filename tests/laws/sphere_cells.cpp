// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/sphere_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrail::laws {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t samples_in_cell = 8;
constexpr int deepest_cell = 80, deepest_integral = 7;
constexpr double absolute_tolerance = 2e-7, relative_tolerance = 1e-3;  // of one cell's integral

// Gauss and Legendre's rule with four nodes, over [0, 1].
constexpr std::array<double, 4> node = {0.069431844202973712, 0.330009478207571868, 0.669990521792428132,
                                        0.930568155797026288};
constexpr std::array<double, 4> weight = {0.173927422568726929, 0.326072577431273071, 0.326072577431273071,
                                          0.173927422568726929};

}  // namespace

SphereCells::SphereCells(const std::vector<Vector3d>& samples, Vector3d seam)
    : seam_azimuth_(std::atan2(seam.y, seam.x)) {
  nodes_.push_back({.axis = 1, .at = 0});  // no cell crosses the surface
  std::vector<Point2d> below, above;
  for (Vector3d s : samples) (s.z < 0 ? below : above).push_back(coordinates(s));
  const std::size_t lower = build({0, 2 * pi, -1, 0}, std::move(below), 0);
  const std::size_t upper = build({0, 2 * pi, 0, 1}, std::move(above), 0);
  nodes_[0].below = lower;
  nodes_[0].above = upper;
}

Point2d SphereCells::coordinates(Vector3d d) const {
  double phi = std::atan2(d.y, d.x) - seam_azimuth_;
  if (phi < 0) phi += 2 * pi;
  if (phi < 0) phi += 2 * pi;
  return {phi, d.z};
}

Vector3d SphereCells::direction(double phi, double z) const {
  const double s = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
  return {s * std::cos(phi + seam_azimuth_), s * std::sin(phi + seam_azimuth_), z};
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
  const auto [x0, x1] =
      std::minmax_element(points.begin(), points.end(), [](Point2d a, Point2d b) { return a.x < b.x; });
  const auto [y0, y1] =
      std::minmax_element(points.begin(), points.end(), [](Point2d a, Point2d b) { return a.y < b.y; });
  const double spread_phi = (x1->x - x0->x) / (box.phi1 - box.phi0);
  const double spread_z = (y1->y - y0->y) / (box.z1 - box.z0);
  const int axis = spread_phi < spread_z ? 0 : 1;
  const double at = axis == 0 ? (box.phi0 + box.phi1) / 2 : (box.z0 + box.z1) / 2;
  Box low = box, high = box;
  (axis == 0 ? low.phi1 : low.z1) = at;
  (axis == 0 ? high.phi0 : high.z0) = at;
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
  const Point2d p = coordinates(d);
  const Node* n = nodes_.data();
  while (n->axis >= 0) n = &nodes_[(n->axis == 0 ? p.x : p.y) < n->at ? n->below : n->above];
  return n->below;
}

double SphereCells::gauss(const std::function<double(Vector3d)>& f, const Box& box) const {
  const double dphi = box.phi1 - box.phi0, dz = box.z1 - box.z0;
  double sum = 0;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (std::size_t j = 0; j < node.size(); ++j)
      sum += weight[i] * weight[j] * f(direction(box.phi0 + dphi * node[i], box.z0 + dz * node[j]));
  return sum * dphi * dz;
}

double SphereCells::adaptive(const std::function<double(Vector3d)>& f, const Box& box, double coarse,
                             int depth) const {
  const double phi = (box.phi0 + box.phi1) / 2, z = (box.z0 + box.z1) / 2;
  const std::array<Box, 4> quarters = {Box{box.phi0, phi, box.z0, z}, Box{phi, box.phi1, box.z0, z},
                                       Box{box.phi0, phi, z, box.z1}, Box{phi, box.phi1, z, box.z1}};
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
