// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/edge_chain.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace vitrail::test {

namespace {

double parameter(Point3d p, const DirectedEdge& e) {
  const Vector3d along = e.to - e.from;
  return dot(p - e.from, along) / dot(along, along);
}

// Vertices of a chain sorted along each axis, to find those near an edge.
class Vertices {
 public:
  explicit Vertices(const std::vector<DirectedEdge>& edges) {
    std::vector<Point3d> all;
    for (const DirectedEdge& e : edges) all.insert(all.end(), {e.from, e.to});
    const auto less = [](Point3d a, Point3d b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::sort(all.begin(), all.end(), less);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (int axis = 0; axis < 3; ++axis) {
      auto& sorted = sorted_[static_cast<std::size_t>(axis)] = all;
      std::sort(sorted.begin(), sorted.end(), [&](Point3d a, Point3d b) { return a[axis] < b[axis]; });
    }
  }

  // All, ascending along x.
  std::span<const Point3d> all() const { return sorted_[0]; }

  // Within the slab around the edge that holds the fewest.
  std::span<const Point3d> near(const DirectedEdge& e, double tolerance) const {
    std::span<const Point3d> best;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& sorted = sorted_[static_cast<std::size_t>(axis)];
      const double lower = std::min(e.from[axis], e.to[axis]) - tolerance;
      const double upper = std::max(e.from[axis], e.to[axis]) + tolerance;
      const auto begin =
          std::partition_point(sorted.begin(), sorted.end(), [&](Point3d p) { return p[axis] < lower; });
      const auto end = std::partition_point(begin, sorted.end(), [&](Point3d p) { return p[axis] <= upper; });
      const std::span<const Point3d> slab(begin, end);
      if (axis == 0 || slab.size() < best.size()) best = slab;
    }
    return best;
  }

 private:
  std::array<std::vector<Point3d>, 3> sorted_;
};

// Each vertex becomes the first one of those within `radius` of it.
std::vector<DirectedEdge> with_close_vertices_merged(const std::vector<DirectedEdge>& edges, double radius) {
  const Vertices vertices(edges);
  const std::span<const Point3d> all = vertices.all();
  std::map<std::array<double, 3>, Point3d> first;
  const auto key = [](Point3d p) { return std::array{p.x, p.y, p.z}; };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!first.try_emplace(key(all[i]), all[i]).second) continue;
    for (std::size_t j = i + 1; j < all.size() && all[j].x <= all[i].x + radius; ++j)
      if (length(all[j] - all[i]) <= radius) first.try_emplace(key(all[j]), all[i]);
  }
  std::vector<DirectedEdge> merged;
  for (const DirectedEdge& e : edges) {
    const DirectedEdge m{first.at(key(e.from)), first.at(key(e.to))};
    if (!(m.from == m.to)) merged.push_back(m);
  }
  return merged;
}

}  // namespace

double distance(Point3d p, const DirectedEdge& e) {
  const double t = std::clamp(parameter(p, e), 0.0, 1.0);
  return length(p - (e.from + (e.to - e.from) * t));
}

void EdgeChain::add(Point3d from, Point3d to, int times) {
  const auto bits = [](Point3d p) {
    return Bits{std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
                std::bit_cast<std::uint64_t>(p.z)};
  };
  const Bits a = bits(from), b = bits(to);
  if (a == b) return;
  int& count = a < b ? count_[{a, b}] : count_[{b, a}];
  count += a < b ? times : -times;
  if (count == 0) count_.erase(a < b ? std::array{a, b} : std::array{b, a});
}

void EdgeChain::add_polygon(std::span<const Point3d> polygon, int times) {
  for (std::size_t i = 0; i < polygon.size(); ++i) add(polygon[i], polygon[(i + 1) % polygon.size()], times);
}

std::vector<DirectedEdge> EdgeChain::edges() const {
  const auto point = [](const Bits& b) {
    return Point3d{std::bit_cast<double>(b[0]), std::bit_cast<double>(b[1]), std::bit_cast<double>(b[2])};
  };
  std::vector<DirectedEdge> edges;
  for (const auto& [ends, count] : count_)
    for (int i = 0; i < std::abs(count); ++i)
      edges.push_back(count > 0 ? DirectedEdge{point(ends[0]), point(ends[1])}
                                : DirectedEdge{point(ends[1]), point(ends[0])});
  return edges;
}

EdgeChain EdgeChain::refined(double tolerance) const {
  const std::vector<DirectedEdge> all = with_close_vertices_merged(edges(), tolerance / 10);
  const Vertices vertices(all);
  EdgeChain result;
  for (const DirectedEdge& e : all) {
    std::vector<Point3d> on;
    for (const Point3d& p : vertices.near(e, tolerance))
      if (!(p == e.from) && !(p == e.to) && distance(p, e) <= tolerance) on.push_back(p);
    std::sort(on.begin(), on.end(), [&](Point3d a, Point3d b) { return parameter(a, e) < parameter(b, e); });
    Point3d last = e.from;
    for (const Point3d& p : on) {
      result.add(last, p);
      last = p;
    }
    result.add(last, e.to);
  }
  return result;
}

}  // namespace vitrail::test
