// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/revolution.h"

#include <cmath>

#include "scene/geometry/unit_circle.h"

namespace vitrail::solids {

namespace {

constexpr int most_chords = 4096;

// Rings of vertices: one on the axis, else one a segment.
class Rings {
 public:
  Rings(std::span<const Point2d> circle, Solid& solid) : circle_(circle), solid_(solid) {}

  std::uint32_t add(Point2d p) {
    const auto first = static_cast<std::uint32_t>(solid_.positions.size());
    if (p.x == 0) {
      solid_.positions.push_back({0, p.y, 0});
    } else {
      for (std::size_t k = 0; k + 1 < circle_.size(); k += 2)
        solid_.positions.push_back({p.x * circle_[k].x, p.y, p.x * circle_[k].y});
    }
    return first;
  }

 private:
  std::span<const Point2d> circle_;  // twice as many as segments: their ends and middles
  Solid& solid_;
};

}  // namespace

// A chord's middle is r (1 − cos(π/n)) ≤ r (π/n)² / 2 from the circle.
int circle_chords(double radius, double tolerance) {
  const double wanted = pi * std::sqrt(radius / (2 * tolerance));
  if (!(wanted < most_chords)) return most_chords;
  return std::max(12, (static_cast<int>(std::ceil(wanted)) + 3) / 4 * 4);
}

void append_arc(std::vector<MeridianChord>& chords, Point2d center, double radius, double begin_rad,
                double end_rad, double tolerance) {
  const double share = std::abs(end_rad - begin_rad) / (2 * pi);
  const int count = std::max(2, static_cast<int>(std::ceil(share * circle_chords(radius, tolerance) - 1e-9)));
  const auto normal = [&](int i) {
    double angle = begin_rad + (end_rad - begin_rad) * i / count;
    if (angle < 0) angle += 2 * pi;
    return unit_circle(angle);
  };
  for (int i = 0; i < count; ++i) {
    const Point2d a = normal(i), b = normal(i + 1);
    chords.push_back({{center.x + radius * a.x, center.y + radius * a.y},
                      {center.x + radius * b.x, center.y + radius * b.y},
                      a,
                      b});
  }
}

void append_line(std::vector<MeridianChord>& chords, Point2d from, Point2d to, std::uint32_t surface) {
  const double dr = to.x - from.x, dy = to.y - from.y, size = std::sqrt(dr * dr + dy * dy);
  const Point2d normal{dy / size, -dr / size};
  chords.push_back({from, to, normal, normal, surface});
}

Solid revolve(std::span<const MeridianChord> chords, int segments) {
  Solid solid;
  const auto n = static_cast<std::uint32_t>(segments);
  std::vector<Point2d> circle;
  for (int k = 0; k < 2 * segments; ++k) circle.push_back(unit_circle(pi * k / segments));
  Rings rings(circle, solid);
  const auto corner_normal = [&](Point2d normal, std::size_t half_step) {
    const Point2d c = circle[half_step % circle.size()];
    return Normal3f{static_cast<float>(normal.x * c.x), static_cast<float>(normal.y),
                    static_cast<float>(normal.x * c.y)};
  };
  if (chords.empty()) return solid;
  const std::uint32_t first = rings.add(chords.front().from);
  std::uint32_t below = first;
  const bool returns = chords.back().to == chords.front().from;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const MeridianChord& c = chords[i];
    const std::uint32_t above = i + 1 == chords.size() && returns ? first : rings.add(c.to);
    const bool from_axis = c.from.x == 0, to_axis = c.to.x == 0;
    for (std::uint32_t k = 0; k < n && !(from_axis && to_axis); ++k) {
      const std::uint32_t next = (k + 1) % n;
      const std::uint32_t a = from_axis ? below : below + k, d = from_axis ? below : below + next;
      const std::uint32_t b = to_axis ? above : above + k, e = to_axis ? above : above + next;
      const std::size_t here = 2 * std::size_t{k}, there = here + 2;
      const auto at_axis = here + 1;  // of the triangle's middle
      const auto add = [&](std::array<std::uint32_t, 3> t, std::array<Normal3f, 3> normals) {
        solid.triangles.push_back(t);
        solid.normals.push_back(normals);
        solid.surfaces.push_back(c.surface);
      };
      if (!from_axis)
        add({a, b, d},
            {corner_normal(c.normal_from, here), corner_normal(c.normal_to, to_axis ? at_axis : here),
             corner_normal(c.normal_from, there)});
      if (!to_axis)
        add({b, e, d}, {corner_normal(c.normal_to, here), corner_normal(c.normal_to, there),
                        corner_normal(c.normal_from, from_axis ? at_axis : there)});
    }
    below = above;
  }
  solid.closed = returns || (chords.front().from.x == 0 && chords.back().to.x == 0);
  return solid;
}

}  // namespace vitrail::solids
