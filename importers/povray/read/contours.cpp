// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/contours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vitrail::pov {

namespace {

using Contour = std::vector<Point3d>;

// Two coordinates of the plane: without the axis that its normal is nearest to.
struct Plane {
  int a = 0, b = 1;
  Point2d of(Point3d p) const { return {p[a], p[b]}; }
};

Plane plane_of(const Contour& contour) {
  Vector3d normal{};
  for (std::size_t i = 0; i < contour.size(); ++i)
    normal = normal + cross(contour[i] - Point3d{}, contour[(i + 1) % contour.size()] - Point3d{});
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  if (x >= y && x >= z) return {1, 2};
  return y >= z ? Plane{2, 0} : Plane{0, 1};
}

double area(const Contour& c, const Plane& plane) {
  double sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Point2d p = plane.of(c[i]), q = plane.of(c[(i + 1) % c.size()]);
    sum += p.x * q.y - q.x * p.y;
  }
  return sum / 2;
}

bool holds(const Contour& c, Point2d at, const Plane& plane) {
  bool inside = false;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Point2d p = plane.of(c[i]), q = plane.of(c[(i + 1) % c.size()]);
    if ((p.y > at.y) != (q.y > at.y) && at.x < (q.x - p.x) * (at.y - p.y) / (q.y - p.y) + p.x)
      inside = !inside;
  }
  return inside;
}

double side(Point2d a, Point2d b, Point2d c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool crosses(const Contour& c, Point2d from, Point2d to, const Plane& plane) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Point2d p = plane.of(c[i]), q = plane.of(c[(i + 1) % c.size()]);
    if (side(from, to, p) * side(from, to, q) < 0 && side(p, q, from) * side(p, q, to) < 0) return true;
  }
  return false;
}

// Cuts from a corner of the hole to the nearest corner of the outer contour that it sees.
void join(Contour& outer, Contour hole, const Plane& plane) {
  if (area(outer, plane) * area(hole, plane) > 0) std::reverse(hole.begin(), hole.end());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < outer.size(); ++i)
    for (std::size_t j = 0; j < hole.size(); ++j) pairs.emplace_back(i, j);
  const auto distance = [&](const auto& pair) { return length(outer[pair.first] - hole[pair.second]); };
  std::sort(pairs.begin(), pairs.end(),
            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const auto free = std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) {
    const Point2d from = plane.of(outer[pair.first]), to = plane.of(hole[pair.second]);
    return !crosses(outer, from, to, plane) && !crosses(hole, from, to, plane);
  });
  const auto [i, j] = free == pairs.end() ? pairs.front() : *free;
  std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(j), hole.end());
  hole.push_back(hole.front());
  hole.push_back(outer[i]);
  outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(i) + 1, hole.begin(), hole.end());
}

}  // namespace

std::vector<Contour> joined_contours(const std::vector<Contour>& contours) {
  if (contours.size() < 2) return contours;
  constexpr std::size_t most_corners = 4000;  // pairs of corners are looked at
  std::size_t corners = 0;
  for (const Contour& c : contours) corners += c.size();
  if (corners > most_corners) return contours;
  const Plane plane = plane_of(contours.front());
  std::vector<std::size_t> order(contours.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(area(contours[a], plane)) > std::abs(area(contours[b], plane));
  });
  std::vector<Contour> outers;
  std::vector<std::size_t> outer_of(contours.size(), 0);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Contour& contour = contours[order[rank]];
    std::size_t depth = 0, around = 0;
    for (std::size_t other = 0; other < rank; ++other)
      if (holds(contours[order[other]], plane.of(contour.front()), plane)) ++depth, around = other;
    if (depth % 2 == 0) {
      outer_of[rank] = outers.size();
      outers.push_back(contour);
    } else {
      outer_of[rank] = outer_of[around];
      join(outers[outer_of[around]], contour, plane);
    }
  }
  return outers;
}

}  // namespace vitrail::pov
