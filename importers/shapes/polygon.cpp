// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/polygon.h"

#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>

#include "importers/shapes/point_tree.h"

namespace vitrail {

namespace {

// Twice the area vector of the polygon (Newell's method, about corner 0).
Vector3d area_vector(std::span<const Point3d> p) {
  Vector3d sum;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum = sum + cross(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

bool fan_tiles(std::span<const Point3d> p, Vector3d normal) {
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    if (!(dot(cross(p[i] - p[0], p[i + 1] - p[0]), normal) > 0)) return false;
  }
  return true;
}

// Drops the axis along which the polygon is thinnest, keeping it counter-clockwise.
std::vector<Point2d> project(std::span<const Point3d> p, Vector3d normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  const int dropped = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
  int first = (dropped + 1) % 3, second = (dropped + 2) % 3;
  if (normal[dropped] < 0) std::swap(first, second);
  std::vector<Point2d> flat;
  flat.reserve(p.size());
  for (const Point3d& q : p) flat.push_back({q[first], q[second]});
  return flat;
}

// The polygon that is left, as a ring of corners. A convex corner is an ear if its triangle holds no concave
// one. It is tested when its triangle has changed or the corner that was found in it is concave no longer, so
// that hardly any test is made twice.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Point2d> corners)
      : p_(std::move(corners)),
        next_(p_.size()),
        previous_(p_.size()),
        version_(p_.size()),
        is_concave_(p_.size()),
        blocked_(p_.size(), none) {
    std::iota(next_.begin(), next_.end(), 1u);
    next_.back() = 0;
    for (std::uint32_t i = 0; i < next_.size(); ++i) previous_[next_[i]] = i;
    std::vector<std::uint32_t> concave;
    for (std::uint32_t i = 0; i < next_.size(); ++i) {
      is_concave_[i] = area(i) <= 0;
      if (is_concave_[i]) {
        concave.push_back(i);
      } else {
        tests_.push_back({i, 0});
      }
    }
    concave_.emplace(p_, std::move(concave));
  }

  void clip(std::vector<CornerTriple>& triangles) {
    std::uint32_t left = 0;  // a corner of what is left
    for (std::size_t count = p_.size(); count > 3; --count) {
      const std::uint32_t ear = find_ear(left), before = previous_[ear], after = next_[ear];
      triangles.push_back({before, ear, after});
      next_[before] = after;
      previous_[after] = before;
      ++version_[ear];
      if (is_concave_[ear]) is_no_longer_concave(ear);
      // Behind all that wait: cutting ears all around makes no fan of slivers.
      for (const std::uint32_t i : {before, after}) has_changed(i);
      left = after;
    }
    triangles.push_back({previous_[left], left, next_[left]});
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  // Of a corner as it was then; it has been superseded if the version is another.
  struct Test {
    std::uint32_t corner, version;
  };

  double area(std::uint32_t i) const { return orientation(p_[previous_[i]], p_[i], p_[next_[i]]); }
  bool is_valid(const Test& test) const { return version_[test.corner] == test.version; }

  void has_changed(std::uint32_t corner) {
    ++version_[corner];
    if (area(corner) <= 0) return;  // convex corners can become flat only where the polygon crosses itself
    if (is_concave_[corner]) is_no_longer_concave(corner);
    tests_.push_back({corner, version_[corner]});
  }

  // What it stood in the way of is tested again.
  void is_no_longer_concave(std::uint32_t corner) {
    is_concave_[corner] = false;
    concave_->remove(corner);
    for (std::uint32_t i = blocked_[corner]; i != none; i = next_blocked_[i]) {
      tests_.push_back(blocked_tests_[i]);
    }
    blocked_[corner] = none;
  }

  // None exists where the polygon crosses itself or has no area left: then any convex corner, else `any`.
  std::uint32_t find_ear(std::uint32_t any) {
    for (; !tests_.empty(); tests_.pop_front()) {
      const Test test = tests_.front();
      if (!is_valid(test)) continue;
      const std::uint32_t i = test.corner;
      const auto inside = concave_->find_within(p_[previous_[i]], p_[i], p_[next_[i]]);
      if (!inside) {
        tests_.pop_front();
        return i;
      }
      block(test, *inside);
    }
    while (first_blocked_ < blocked_tests_.size()) {
      const Test test = blocked_tests_[first_blocked_++];
      if (is_valid(test)) return test.corner;
    }
    return any;
  }

  void block(const Test& test, std::uint32_t by) {
    const auto index = static_cast<std::uint32_t>(blocked_tests_.size());
    blocked_tests_.push_back(test);
    next_blocked_.push_back(blocked_[by]);
    blocked_[by] = index;
  }

  std::vector<Point2d> p_;
  std::vector<std::uint32_t> next_, previous_, version_;
  std::vector<bool> is_concave_;  // not strictly convex, and not clipped yet
  std::optional<PointTree> concave_;
  std::deque<Test> tests_;
  std::vector<Test> blocked_tests_;                    // all that have failed
  std::vector<std::uint32_t> blocked_, next_blocked_;  // by each corner: lists of them
  std::size_t first_blocked_ = 0;
};

}  // namespace

void triangulate_polygon(std::span<const Point3d> corners, std::vector<CornerTriple>& triangles) {
  if (corners.size() > 3) {
    const Vector3d normal = area_vector(corners);
    if (dot(normal, normal) > 0 && !fan_tiles(corners, normal)) {
      EarClipper(project(corners, normal)).clip(triangles);
      return;
    }
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.push_back({0, i, i + 1});
}

}  // namespace vitrail
