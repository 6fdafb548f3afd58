// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry/transform.h"

namespace vitrail {

namespace {

// Cofactor of entry (i, j) of the upper 3×3 block; cyclic indices carry the sign.
double cofactor3(const Transform& t, int i, int j) {
  const auto r0 = static_cast<std::size_t>((i + 1) % 3), r1 = static_cast<std::size_t>((i + 2) % 3);
  const auto c0 = static_cast<std::size_t>((j + 1) % 3), c1 = static_cast<std::size_t>((j + 2) % 3);
  return t.m[r0][c0] * t.m[r1][c1] - t.m[r0][c1] * t.m[r1][c0];
}

// Signed cofactor of entry (i, j) of the whole matrix.
double cofactor4(const Transform& t, std::size_t i, std::size_t j) {
  std::array<std::size_t, 3> rows{}, columns{};
  for (std::size_t k = 0, r = 0, c = 0; k < 4; ++k) {
    if (k != i) rows[r++] = k;
    if (k != j) columns[c++] = k;
  }
  const auto at = [&](std::size_t r, std::size_t c) { return t.m[rows[r]][columns[c]]; };
  const double minor = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
                       at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
                       at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
  return (i + j) % 2 == 0 ? minor : -minor;
}

double determinant4(const Transform& t) {
  double sum = 0;
  for (std::size_t j = 0; j < 4; ++j) sum += t.m[0][j] * cofactor4(t, 0, j);
  return sum;
}

}  // namespace

Transform operator*(const Transform& a, const Transform& b) {
  Transform product;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a.m[i][k] * b.m[k][j];
      product.m[i][j] = sum;
    }
  return product;
}

Transform translate(Vector3d by) {
  Transform t;
  t.m[0][3] = by.x;
  t.m[1][3] = by.y;
  t.m[2][3] = by.z;
  return t;
}

Transform scale(Vector3d by) {
  Transform t;
  t.m[0][0] = by.x;
  t.m[1][1] = by.y;
  t.m[2][2] = by.z;
  return t;
}

Transform rotate(double angle_rad, Vector3d axis) {
  const Vector3d a = normalize(axis);
  if (!(length(axis) > 0)) return {};
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  Transform t;
  t.m[0] = {a.x * a.x + (1 - a.x * a.x) * c, a.x * a.y * (1 - c) - a.z * s, a.x * a.z * (1 - c) + a.y * s, 0};
  t.m[1] = {a.x * a.y * (1 - c) + a.z * s, a.y * a.y + (1 - a.y * a.y) * c, a.y * a.z * (1 - c) - a.x * s, 0};
  t.m[2] = {a.x * a.z * (1 - c) - a.y * s, a.y * a.z * (1 - c) + a.x * s, a.z * a.z + (1 - a.z * a.z) * c, 0};
  return t;
}

Transform look_at(Point3d eye, Point3d target, Vector3d up) {
  const Vector3d view = normalize(target - eye);
  const Vector3d right = normalize(cross(normalize(up), view));
  const Vector3d true_up = cross(view, right);
  Transform t;
  for (int axis = 0; axis < 3; ++axis)
    t.m[static_cast<std::size_t>(axis)] = {right[axis], true_up[axis], view[axis], eye[axis]};
  return t;
}

bool is_invertible(const Transform& t) {
  const double det = determinant4(t);
  return std::isfinite(det) && det != 0;
}

Transform inverse(const Transform& t) {
  const double reciprocal = 1 / determinant4(t);
  Transform result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result.m[j][i] = cofactor4(t, i, j) * reciprocal;
  return result;
}

Point3d transform_point(const Transform& t, Point3d p) {
  const auto row = [&](std::size_t i) {
    return t.m[i][0] * p.x + t.m[i][1] * p.y + t.m[i][2] * p.z + t.m[i][3];
  };
  const double w = row(3);
  if (w == 1 || w == 0) return {row(0), row(1), row(2)};
  return {row(0) / w, row(1) / w, row(2) / w};
}

Vector3d transform_vector(const Transform& t, Vector3d v) {
  const auto row = [&](std::size_t i) { return t.m[i][0] * v.x + t.m[i][1] * v.y + t.m[i][2] * v.z; };
  return {row(0), row(1), row(2)};
}

Normal3d transform_normal(const Transform& t, Normal3d n) {
  const double sign = determinant3(t) < 0 ? -1 : 1;
  const auto row = [&](int i) {
    return sign * (cofactor3(t, i, 0) * n.x + cofactor3(t, i, 1) * n.y + cofactor3(t, i, 2) * n.z);
  };
  return {row(0), row(1), row(2)};
}

namespace {

// 2⁻⁴⁰ of the power of two above `greatest`; 0 has no rounding.
double rounded_to_40_bits(double value, double greatest) {
  if (!(greatest > 0) || !std::isfinite(greatest)) return value;
  int exponent = 0;
  std::frexp(greatest, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(value, 40 - exponent)), exponent - 40) + 0.0;
}

}  // namespace

Transform snapped(const Transform& t) {
  Transform result = t;
  double greatest = 0, farthest = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      greatest = std::max(greatest, std::abs(t.m[row][column]));
    farthest = std::max(farthest, std::abs(t.m[row][3]));
  }
  // Rounding may reach the next power of two, which a second call would start from.
  greatest = rounded_to_40_bits(greatest, greatest);
  farthest = rounded_to_40_bits(farthest, farthest);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      result.m[row][column] = rounded_to_40_bits(t.m[row][column], greatest);
    result.m[row][3] = rounded_to_40_bits(t.m[row][3], farthest);
  }
  return result;
}

double determinant3(const Transform& t) {
  return t.m[0][0] * cofactor3(t, 0, 0) + t.m[0][1] * cofactor3(t, 0, 1) + t.m[0][2] * cofactor3(t, 0, 2);
}

bool swaps_handedness(const Transform& t) { return determinant3(t) < 0; }

}  // namespace vitrail
