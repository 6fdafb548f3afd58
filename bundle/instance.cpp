// SPDX-License-Identifier: Apache-2.0
#include "bundle/instance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bundle/domain_file.h"
#include "scene/shapes/curve.h"

namespace vitrail {

namespace {

Transform transform_of(const Affine& a) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(a.m[i], 4, t.m[i].begin());
  return t;
}

}  // namespace

bool is_affine(const Transform& t) { return t.m[3] == std::array<double, 4>{0, 0, 0, 1}; }

Affine affine(const Transform& t) {
  Affine a;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(t.m[i].begin(), 4, a.m[i]);
  return a;
}

Affine compose(const Affine& a, const Affine& b) {
  Affine product;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      product.m[i][j] =
          a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + (j == 3 ? a.m[i][3] : 0);
  return product;
}

Affine compose(const Affine& outer, const Quadric& quadric, const Affine& place) {
  if (!is_curve(quadric)) return compose(outer, place);
  return affine(packed(transformed(transform_of(outer), unpacked_curve(place.m))));
}

bool mirrors(const Affine& a) {
  const auto& m = a.m;
  const auto minor = [&](int i, int j) { return m[1][i] * m[2][j] - m[1][j] * m[2][i]; };
  return m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1) < 0;
}

Point3f placed(const Affine& a, Point3f p) {
  const auto& m = a.m;
  const Point3d at = cast<double>(p);
  const auto row = [&](std::size_t i) {
    return static_cast<float>(m[i][0] * at.x + m[i][1] * at.y + m[i][2] * at.z + m[i][3]) + 0.0f;
  };
  return {row(0), row(1), row(2)};
}

Bounds3f placed_bounds(const Affine& a, const Bounds3f& box) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Bounds3f out;
  if (box.empty()) return out;
  for (int i = 0; i < 3; ++i) {
    double lower = a.m[i][3], upper = a.m[i][3];
    for (int j = 0; j < 3; ++j) {
      const double x = a.m[i][j] * double{box.lower[j]}, y = a.m[i][j] * double{box.upper[j]};
      lower += std::min(x, y);
      upper += std::max(x, y);
    }
    out.lower[i] = std::nextafter(static_cast<float>(lower), -infinity);
    out.upper[i] = std::nextafter(static_cast<float>(upper), infinity);
  }
  return out;
}

Bounds3f box_of(const InstanceRef& ref) {
  return {{ref.lower[0], ref.lower[1], ref.lower[2]}, {ref.upper[0], ref.upper[1], ref.upper[2]}};
}

void set_box(InstanceRef& ref, const Bounds3f& box) {
  for (int axis = 0; axis < 3; ++axis) {
    ref.lower[axis] = box.lower[axis];
    ref.upper[axis] = box.upper[axis];
  }
}

std::uint32_t placed_normal(const Affine& m, std::uint32_t code) {
  if (code == no_normal) return no_normal;
  return encode_normal(transform_normal(transform_of(m), cast<double>(decode_normal(code))));
}

}  // namespace vitrail
