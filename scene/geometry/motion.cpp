// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/geometry/portable_math.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Quaternion = std::array<double, 4>;

double dot4(const Quaternion& a, const Quaternion& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

Transform linear(const Matrix3& m) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(m[i].begin(), 3, t.m[i].begin());
  return t;
}

Matrix3 linear_part(const Transform& t) {
  Matrix3 m;
  for (std::size_t i = 0; i < 3; ++i) std::copy_n(t.m[i].begin(), 3, m[i].begin());
  return m;
}

// The rotation of M = R·S, S symmetric: the limit of M ← (M + M⁻ᵀ)/2 (Higham 1986). −1 times it where M
// mirrors.
Matrix3 orthogonal_part(const Matrix3& of) {
  constexpr int most_steps = 200;
  Matrix3 m = of;
  for (int step = 0; step < most_steps; ++step) {
    const Matrix3 inverted = linear_part(inverse(linear(m)));
    double change = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double next = (m[i][j] + inverted[j][i]) / 2;
        change = std::max(change, std::abs(next - m[i][j]));
        m[i][j] = next;
      }
    if (!(change > 1e-15)) break;
  }
  return m;
}

// Of a rotation (Shoemake 1985), by its greatest component, which is at least 1/2.
Quaternion quaternion_of(const Matrix3& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  const std::array<double, 4> squares{1 + 2 * r[0][0] - trace, 1 + 2 * r[1][1] - trace,
                                      1 + 2 * r[2][2] - trace, 1 + trace};  // four times each
  const auto greatest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
  Quaternion q;
  const double four = 2 * std::sqrt(squares[greatest]);  // times the component
  q[greatest] = four / 4;
  if (greatest == 3) {
    q[0] = (r[2][1] - r[1][2]) / four;
    q[1] = (r[0][2] - r[2][0]) / four;
    q[2] = (r[1][0] - r[0][1]) / four;
    return q;
  }
  const std::size_t i = greatest, j = (i + 1) % 3, k = (i + 2) % 3;
  q[j] = (r[i][j] + r[j][i]) / four;
  q[k] = (r[i][k] + r[k][i]) / four;
  q[3] = (r[k][j] - r[j][k]) / four;
  return q;
}

Matrix3 matrix_of(const Quaternion& q) {
  const auto& [x, y, z, w] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

// Of two unit quaternions (Kahan).
double angle_between(const Quaternion& a, const Quaternion& b) {
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    sum += (a[i] + b[i]) * (a[i] + b[i]);
  }
  return 2 * portable_atan2(std::sqrt(difference), std::sqrt(sum));
}

// Along the great arc, t in [0,1] of its angle.
Quaternion slerp(const Quaternion& a, const Quaternion& b, double angle, double t) {
  constexpr double straight = 1e-7;  // sin x is x to 10⁻¹⁵
  const bool is_short = angle < straight;
  const double reciprocal = is_short ? 1 : 1 / portable_sin(angle);  // the angle is at most π/2
  const double of_a = is_short ? 1 - t : portable_sin((1 - t) * angle) * reciprocal,
               of_b = is_short ? t : portable_sin(t * angle) * reciprocal;
  Quaternion q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = of_a * a[i] + of_b * b[i];
  return q;
}

double norm(const Transform& t) {
  const auto row = [&](std::size_t i) {
    return std::abs(t.m[i][0]) + std::abs(t.m[i][1]) + std::abs(t.m[i][2]);
  };
  return std::max({row(0), row(1), row(2)});
}

double length_of(const Matrix3& m, Point3d p) {
  const Vector3d v = transform_vector(linear(m), p - Point3d{});
  return length(v);
}

std::array<Point3d, 8> corners_of(const Bounds3d& b) {
  std::array<Point3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1 ? b.upper : b.lower).x, (i & 2 ? b.upper : b.lower).y,
                  (i & 4 ? b.upper : b.lower).z};
  return corners;
}

}  // namespace

bool can_move(const std::vector<Keyframe>& keys) {
  constexpr double most_condition = 1e4;
  double greatest = 0, greatest_inverse = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Transform& t = keys[i].transform;
    if (!std::isfinite(keys[i].time_s) || (i > 0 && !(keys[i - 1].time_s < keys[i].time_s))) return false;
    if (t.m[3] != std::array<double, 4>{0, 0, 0, 1} || !is_invertible(t)) return false;
    if (swaps_handedness(t) != swaps_handedness(keys[0].transform)) return false;
    greatest = std::max(greatest, norm(t));
    greatest_inverse = std::max(greatest_inverse, norm(inverse(t)));
  }
  return !keys.empty() && greatest * greatest_inverse <= most_condition;
}

Motion::Parts Motion::parts_of(const Transform& t) {
  Matrix3 rotation = orthogonal_part(linear_part(t));
  if (swaps_handedness(t))
    for (auto& row : rotation)
      for (double& x : row) x = -x;
  Parts parts{{t.m[0][3], t.m[1][3], t.m[2][3]}, quaternion_of(rotation), {}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) parts.stretch[i][j] += rotation[k][i] * t.m[k][j];
  return parts;
}

Motion::Motion(std::vector<Keyframe> keys) : keys_(std::move(keys)) {
  if (!can_move(keys_)) throw Error("keyframes are out of order, or one has no place between the others");
  for (const Keyframe& key : keys_) {
    Parts parts = parts_of(key.transform);
    if (!parts_.empty()) {
      const Quaternion& before = parts_.back().rotation;
      if (dot4(before, parts.rotation) < 0)
        for (double& x : parts.rotation) x = -x;
      half_angles_rad_.push_back(angle_between(before, parts.rotation));
    }
    parts_.push_back(parts);
  }
}

Transform Motion::at(double time_s) const {
  if (time_s <= keys_.front().time_s) return keys_.front().transform;
  if (time_s >= keys_.back().time_s) return keys_.back().transform;
  std::size_t key = 0;
  while (keys_[key + 1].time_s < time_s) ++key;
  return between(key, (time_s - keys_[key].time_s) / (keys_[key + 1].time_s - keys_[key].time_s));
}

Transform Motion::between(std::size_t key, double t) const {
  const Parts &a = parts_[key], &b = parts_[key + 1];
  const Matrix3 rotation = matrix_of(slerp(a.rotation, b.rotation, half_angles_rad_[key], t));
  Matrix3 stretch;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) stretch[i][j] = (1 - t) * a.stretch[i][j] + t * b.stretch[i][j];
  Transform m = linear(rotation) * linear(stretch);
  const Vector3d translation = a.translation * (1 - t) + b.translation * t;
  m.m[0][3] = translation.x, m.m[1][3] = translation.y, m.m[2][3] = translation.z;
  return m;
}

// Over a step of 1/n of an arc a point p + T(t) + R(t)·S(t)·p is at most max|f″|/8n² beside the chord of its
// ends; T and S are linear, R turns by ω in all: |f″| ≤ ω²·|S·p| + 2ω·|ΔS·p|. The greatest of both is at a
// corner.
Bounds3d Motion::swept(const Bounds3d& box) const {
  Bounds3d out;
  if (box.empty()) return out;
  const std::array<Point3d, 8> corners = corners_of(box);
  const auto extend_by = [&](const Transform& m, double margin) {
    const Vector3d beside{margin, margin, margin};
    for (const Point3d& corner : corners) {
      const Point3d p = transform_point(m, corner);
      extend(out, p - beside), extend(out, p + beside);
    }
  };
  const auto rounding = [](const Transform& m, double reach) {
    return 1e-14 * (std::abs(m.m[0][3]) + std::abs(m.m[1][3]) + std::abs(m.m[2][3]) + reach);
  };
  extend_by(keys_[0].transform, 0);
  for (std::size_t key = 0; key + 1 < keys_.size(); ++key) {
    const Parts &a = parts_[key], &b = parts_[key + 1];
    Matrix3 change;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) change[i][j] = b.stretch[i][j] - a.stretch[i][j];
    double reach = 0, grown = 0;
    for (const Point3d& p : corners) {
      reach = std::max({reach, length_of(a.stretch, p), length_of(b.stretch, p)});
      grown = std::max(grown, length_of(change, p));
    }
    const double turn = 2 * half_angles_rad_[key];
    const int steps = turn > 0 ? 32 : 1;
    const double beside = (turn * turn * reach + 2 * turn * grown) / (8.0 * steps * steps);
    for (int step = 0; step <= steps; ++step) {
      const Transform m = step == 0       ? keys_[key].transform
                          : step == steps ? keys_[key + 1].transform
                                          : between(key, static_cast<double>(step) / steps);
      extend_by(m, beside + rounding(m, reach));
    }
  }
  return out;
}

Motion operator*(const Transform& outer, const Motion& motion) {
  std::vector<Keyframe> keys = motion.keys();
  for (Keyframe& key : keys) key.transform = outer * key.transform;
  return keys.empty() ? Motion{} : Motion(std::move(keys));
}

bool stands_still(const Motion& motion, const Shutter& shutter) {
  const std::vector<Keyframe>& keys = motion.keys();
  if (!(shutter.open_s < shutter.close_s)) return true;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const bool is_seen = keys[i].time_s < shutter.close_s && keys[i + 1].time_s > shutter.open_s;
    if (is_seen && keys[i].transform != keys[i + 1].transform) return false;
  }
  return true;
}

}  // namespace vitrail
