// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "importers/solids/implicit.h"
#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// The components that reach into each cell of a grid over the blob.
class BlobField {
 public:
  explicit BlobField(const Blob& blob) : threshold_(blob.threshold), lists_(side * side * side) {
    for (const BlobComponent& c : blob.components) {
      if (!std::isfinite(c.radius) || !(c.radius > 0) || !std::isfinite(c.strength) || !is_finite(c.end1) ||
          !is_finite(c.end2) || !is_invertible(c.to_blob))
        throw Error("a component of a blob has no finite place, radius or strength");
      parts_.push_back({c.end1, c.end2 - c.end1, c.radius, c.strength, inverse(c.to_blob), bounds(c)});
      if (c.strength > 0) extend(bounds_, parts_.back().bounds);
    }
    const Vector3d size = extent(bounds_);
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const Bounds3d& b = parts_[i].bounds;
      std::array<std::size_t, 3> low{}, high{};
      for (int axis = 0; axis < 3; ++axis) {
        low[static_cast<std::size_t>(axis)] = cell(b.lower[axis], axis, size);
        high[static_cast<std::size_t>(axis)] = cell(b.upper[axis], axis, size);
      }
      for (std::size_t z = low[2]; z <= high[2]; ++z)
        for (std::size_t y = low[1]; y <= high[1]; ++y)
          for (std::size_t x = low[0]; x <= high[0]; ++x) lists_[(z * side + y) * side + x].push_back(i);
    }
  }

  double operator()(const Point3d& p) const {
    const Vector3d size = extent(bounds_);
    double sum = 0;
    for (const std::uint32_t i :
         lists_[(cell(p.z, 2, size) * side + cell(p.y, 1, size)) * side + cell(p.x, 0, size)])
      sum += density(parts_[i], p);
    return threshold_ - sum;
  }

  // Where no part reaches the sum is 0, which is below a positive threshold.
  bool is_outside(const Bounds3d& box) const {
    if (!(threshold_ > 0)) return false;
    const Vector3d size = extent(bounds_);
    std::array<std::size_t, 3> low{}, high{};
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      low[i] = cell(box.lower[axis], axis, size), high[i] = cell(box.upper[axis], axis, size);
      cells *= high[i] - low[i] + 1;
    }
    constexpr std::size_t most_cells = 64;
    if (cells > most_cells) return false;
    for (std::size_t z = low[2]; z <= high[2]; ++z)
      for (std::size_t y = low[1]; y <= high[1]; ++y)
        for (std::size_t x = low[0]; x <= high[0]; ++x)
          for (const std::uint32_t i : lists_[(z * side + y) * side + x])
            if (parts_[i].strength > 0 && boxes_meet(parts_[i].bounds, box)) return false;
    return true;
  }

  const Bounds3d& bounds() const { return bounds_; }

 private:
  static constexpr std::size_t side = 24;
  struct Part {
    Point3d from;
    Vector3d along;
    double radius, strength;
    Transform from_blob;
    Bounds3d bounds;
  };

  static Bounds3d bounds(const BlobComponent& c) {
    Bounds3d own, moved;
    for (const Point3d& p : {c.end1, c.end2}) {
      extend(own, p - Vector3d{c.radius, c.radius, c.radius});
      extend(own, p + Vector3d{c.radius, c.radius, c.radius});
    }
    for (int i = 0; i < 8; ++i)
      extend(moved,
             transform_point(c.to_blob, {i & 1 ? own.upper.x : own.lower.x, i & 2 ? own.upper.y : own.lower.y,
                                         i & 4 ? own.upper.z : own.lower.z}));
    return moved;
  }

  std::size_t cell(double at, int axis, const Vector3d& size) const {
    const double t = (at - bounds_.lower[axis]) / size[axis] * side;
    return t > 0 ? std::min(static_cast<std::size_t>(t), side - 1) : 0;
  }

  static double density(const Part& part, const Point3d& at) {
    const Vector3d v = transform_point(part.from_blob, at) - part.from;
    const double whole = dot(part.along, part.along);
    const double t = whole > 0 ? std::clamp(dot(v, part.along) / whole, 0.0, 1.0) : 0;
    const Vector3d off = v - part.along * t;
    const double share = 1 - dot(off, off) / (part.radius * part.radius);
    return share > 0 ? part.strength * share * share : 0;
  }

  double threshold_;
  std::vector<Part> parts_;
  Bounds3d bounds_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

}  // namespace

Solid blob(const Blob& blob, const Tessellation& tessellation) {
  const auto field = std::make_shared<BlobField>(blob);
  if (field->bounds().empty()) return {};
  const Vector3d size = extent(field->bounds());
  double smallest = 1e300;
  for (const BlobComponent& c : blob.components) {
    const double size_of = portable_pow(std::abs(determinant3(c.to_blob)), 1.0 / 3);
    smallest = std::min(smallest, c.radius * size_of);
  }
  const double wanted = 5 * std::max({size.x, size.y, size.z}) / smallest;
  return implicit({.field = [field](const Point3d& p) { return (*field)(p); },
                   .container = field->bounds(),
                   .is_outside = [field](const Bounds3d& box) { return field->is_outside(box); },
                   .cells = static_cast<int>(std::clamp(wanted, 32.0, 160.0))},
                  tessellation);
}

}  // namespace vitrail::solids
