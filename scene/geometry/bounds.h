// SPDX-License-Identifier: Apache-2.0
// These are axis-aligned boxes. A default box is empty: lower > upper on every axis.
#pragma once

#include <limits>

#include "scene/geometry/vec.h"

namespace vitrail {

// It is a box along the axes; as it begins, it is empty.
template <class T>
struct Bounds3 {
  Point3<T> lower{std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity(),
                  std::numeric_limits<T>::infinity()};
  Point3<T> upper{-std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
                  -std::numeric_limits<T>::infinity()};

  // Returns whether nothing is inside, not even a point. A box of NaN is empty.
  bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  bool operator==(const Bounds3&) const = default;
};

using Bounds3f = Bounds3<float>;
using Bounds3d = Bounds3<double>;

// Extends a box to the least that holds it and the point.
template <class T>
void extend(Bounds3<T>& b, Point3<T> p) {
  b.lower = {std::min(b.lower.x, p.x), std::min(b.lower.y, p.y), std::min(b.lower.z, p.z)};
  b.upper = {std::max(b.upper.x, p.x), std::max(b.upper.y, p.y), std::max(b.upper.z, p.z)};
}

// Extends a box to the least that holds both.
template <class T>
void extend(Bounds3<T>& b, const Bounds3<T>& other) {
  extend(b, other.lower);
  extend(b, other.upper);
}

// Returns the box that both hold; it is empty where they do not meet.
template <class T>
Bounds3<T> common(const Bounds3<T>& a, const Bounds3<T>& b) {
  return {{std::max(a.lower.x, b.lower.x), std::max(a.lower.y, b.lower.y), std::max(a.lower.z, b.lower.z)},
          {std::min(a.upper.x, b.upper.x), std::min(a.upper.y, b.upper.y), std::min(a.upper.z, b.upper.z)}};
}

// Returns the lengths of the box's three edges; 0 when empty.
template <class T>
Vector3<T> extent(const Bounds3<T>& b) {
  return b.empty() ? Vector3<T>{} : b.upper - b.lower;
}

// Returns the surface area of the six faces; 0 when empty.
template <class T>
T surface_area(const Bounds3<T>& b) {
  const Vector3<T> e = extent(b);
  return T(2) * (e.x * e.y + e.y * e.z + e.z * e.x);
}

// Returns the box's middle; NaN when empty.
template <class T>
Point3<T> center(const Bounds3<T>& b) {
  return {(b.lower.x + b.upper.x) / 2, (b.lower.y + b.upper.y) / 2, (b.lower.z + b.upper.z) / 2};
}

}  // namespace vitrail
