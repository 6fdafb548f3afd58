// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/halving.h"

#include <unordered_map>

namespace vitrail::solids {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t none = 0xffffffff;

struct Edge {
  Lies on = 0;
  bool is_checked = false, is_halved = false;
  std::uint32_t middle = none;
};

std::uint64_t key(std::uint64_t a, std::uint64_t b) { return a < b ? a << 32 | b : b << 32 | a; }

// The edges of all rounds: each is checked once.
class Edges {
 public:
  Edges(std::vector<Point3d>& positions, const Projection& project, double tolerance)
      : positions_(positions), project_(project), tolerance_(tolerance) {}

  void add(const Triangle& t, Lies lies) {
    for (std::size_t i = 0; i < 3; ++i) edges_[key(t[i], t[(i + 1) % 3])].on |= lies;
  }

  // Halves edges that are too far, or the longest if the centre is. Says whether the triangle is near enough.
  bool check(const Triangle& t, Lies lies) {
    bool halved = false;
    std::size_t longest = 0;
    double greatest = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double size = square(t[i], t[(i + 1) % 3]);
      if (size > greatest) greatest = size, longest = i;
      Edge& edge = edges_[key(t[i], t[(i + 1) % 3])];
      if (!edge.is_checked) check(edge, t[i], t[(i + 1) % 3]);
      halved = halved || edge.is_halved;
    }
    if (halved) return false;
    const Point3d a = positions_[t[0]];
    const Point3d middle = a + ((positions_[t[1]] - a) + (positions_[t[2]] - a)) * (1.0 / 3);
    const auto on = project_(middle, lies);
    if (!on || !is_far(middle, *on, greatest)) return true;
    Edge& edge = edges_[key(t[longest], t[(longest + 1) % 3])];
    halve_edge(edge, t[longest], t[(longest + 1) % 3]);
    return false;
  }

  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) const {
    const auto found = edges_.find(key(a, b));
    return found == edges_.end() ? none : found->second.middle;
  }

  double square(std::uint32_t a, std::uint32_t b) const {
    const Vector3d d = positions_[b] - positions_[a];
    return dot(d, d);
  }

 private:
  // Far, but not so far that the projection went astray.
  bool is_far(const Point3d& p, const Point3d& on, double edge_squared) const {
    const Vector3d off = on - p;
    const double far = dot(off, off);
    return far > tolerance_ * tolerance_ && far < edge_squared;
  }

  void check(Edge& edge, std::uint32_t a, std::uint32_t b) {
    edge.is_checked = true;
    const Point3d middle = positions_[a] + (positions_[b] - positions_[a]) * 0.5;
    const auto on = project_(middle, edge.on);
    if (on && is_far(middle, *on, square(a, b))) add_middle(edge, *on);
  }

  void halve_edge(Edge& edge, std::uint32_t a, std::uint32_t b) {
    const Point3d middle = positions_[a] + (positions_[b] - positions_[a]) * 0.5;
    const auto on = project_(middle, edge.on);
    add_middle(edge, on && !is_astray(middle, *on, square(a, b)) ? *on : middle);
  }

  static bool is_astray(const Point3d& p, const Point3d& on, double edge_squared) {
    return dot(on - p, on - p) >= edge_squared;
  }

  void add_middle(Edge& edge, const Point3d& p) {
    edge.is_halved = true;
    edge.middle = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(p);
  }

  std::vector<Point3d>& positions_;
  const Projection& project_;
  double tolerance_;
  std::unordered_map<std::uint64_t, Edge> edges_;
};

// The parts of a triangle whose edges have these middles, `none` where they are whole.
template <class Add>
void parts(const Edges& edges, Triangle t, Add&& add) {
  std::array<std::uint32_t, 3> m{};
  std::size_t halved = 0;
  for (std::size_t i = 0; i < 3; ++i) halved += (m[i] = edges.middle_of(t[i], t[(i + 1) % 3])) != none;
  // Turned so that one halved edge is the first, or two the first and the second.
  const auto turn = [&] {
    t = {t[1], t[2], t[0]};
    m = {m[1], m[2], m[0]};
  };
  if (halved == 1)
    while (m[0] == none) turn();
  if (halved == 2)
    while (m[2] != none) turn();
  if (halved == 0) add(t);
  if (halved == 1) {
    add({t[0], m[0], t[2]});
    add({m[0], t[1], t[2]});
  }
  if (halved == 2) {
    add({m[0], t[1], m[1]});
    if (edges.square(t[0], m[1]) < edges.square(m[0], t[2])) {
      add({t[0], m[0], m[1]});
      add({t[0], m[1], t[2]});
    } else {
      add({t[0], m[0], t[2]});
      add({m[0], m[1], t[2]});
    }
  }
  if (halved == 3) {
    add({t[0], m[0], m[2]});
    add({m[0], t[1], m[1]});
    add({m[2], m[1], t[2]});
    add({m[0], m[1], m[2]});
  }
}

}  // namespace

void halve(std::vector<Point3d>& positions, std::vector<Triangle>& triangles, std::vector<Lies>& lies,
           const Projection& project, const Halving& halving) {
  Edges edges(positions, project, halving.tolerance);
  std::vector<bool> is_near(triangles.size());
  for (int i = 0; i < halving.rounds && triangles.size() < halving.most_triangles; ++i) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!is_near[t]) edges.add(triangles[t], lies[t]);
    const std::size_t before = positions.size();
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!is_near[t]) is_near[t] = edges.check(triangles[t], lies[t]);
    if (positions.size() == before) return;
    std::vector<Triangle> next;
    std::vector<Lies> next_lies;
    std::vector<bool> next_near;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      parts(edges, triangles[t], [&](const Triangle& part) {
        next.push_back(part);
        next_lies.push_back(lies[t]);
        next_near.push_back(is_near[t] && part == triangles[t]);
      });
    triangles = std::move(next);
    lies = std::move(next_lies);
    is_near = std::move(next_near);
  }
}

}  // namespace vitrail::solids
