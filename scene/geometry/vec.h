// SPDX-License-Identifier: Apache-2.0
// Points, vectors and normals are distinct types: a point transforms with translation, a vector without it,
// a normal by the inverse transpose. Conversions between them are explicit.
#pragma once

#include <algorithm>
#include <cmath>

namespace vitrail {

// It is a direction with a length, a difference of points.
template <class T>
struct Vector3 {
  T x{}, y{}, z{};
  // Returns x, y and z for the axes 0, 1 and 2.
  constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vector3&) const = default;
};

// It is a place.
template <class T>
struct Point3 {
  T x{}, y{}, z{};
  // Returns x, y and z for the axes 0, 1 and 2.
  constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Point3&) const = default;
};

// It is perpendicular to a surface, and transforms by the inverse transpose.
template <class T>
struct Normal3 {
  T x{}, y{}, z{};
  bool operator==(const Normal3&) const = default;
};

// It is a place on a plane.
template <class T>
struct Point2 {
  T x{}, y{};
  bool operator==(const Point2&) const = default;
};

using Vector3f = Vector3<float>;
using Vector3d = Vector3<double>;
using Point3f = Point3<float>;
using Point3d = Point3<double>;
using Normal3f = Normal3<float>;
using Normal3d = Normal3<double>;
using Point2f = Point2<float>;
using Point2d = Point2<double>;

// clang-format off
// These work component by component.
template <class T> constexpr Vector3<T> operator+(Vector3<T> a, Vector3<T> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T> constexpr Vector3<T> operator-(Vector3<T> a, Vector3<T> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T> constexpr Vector3<T> operator-(Vector3<T> a) { return {-a.x, -a.y, -a.z}; }
template <class T> constexpr Vector3<T> operator*(Vector3<T> a, T s) { return {a.x * s, a.y * s, a.z * s}; }
template <class T> constexpr Vector3<T> operator*(T s, Vector3<T> a) { return a * s; }
template <class T> constexpr Point3<T> operator+(Point3<T> p, Vector3<T> v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
template <class T> constexpr Point3<T> operator-(Point3<T> p, Vector3<T> v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
template <class T> constexpr Vector3<T> operator-(Point3<T> a, Point3<T> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T> constexpr Normal3<T> operator-(Normal3<T> n) { return {-n.x, -n.y, -n.z}; }

// They are Euclidean: a · b, a × b and |v|.
template <class T> constexpr T dot(Vector3<T> a, Vector3<T> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T> constexpr Vector3<T> cross(Vector3<T> a, Vector3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Returns the root of v · v: it overflows where that does.
template <class T> T length(Vector3<T> v) { return std::sqrt(dot(v, v)); }
// clang-format on

// Returns the unit vector along v; v itself where its length is zero or not finite, so that no NaN is made
// here.
template <class T>
Vector3<T> normalize(Vector3<T> v) {
  const T l = length(v);
  return l > T(0) && std::isfinite(l) ? v * (T(1) / l) : v;
}

// Normalizes, but returns v itself where its length is 1 to rounding: a vector that is written and read stays
// the same.
inline Vector3<double> unit(Vector3<double> v) { return std::abs(dot(v, v) - 1) < 1e-15 ? v : normalize(v); }

// Casts component by component, rounded to the nearest.
template <class To, class From>
constexpr Vector3<To> cast(Vector3<From> v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}
template <class To, class From>
constexpr Point3<To> cast(Point3<From> p) {
  return {static_cast<To>(p.x), static_cast<To>(p.y), static_cast<To>(p.z)};
}
template <class To, class From>
constexpr Normal3<To> cast(Normal3<From> n) {
  return {static_cast<To>(n.x), static_cast<To>(n.y), static_cast<To>(n.z)};
}
// They return the same three numbers as another type.
template <class T>
constexpr Vector3<T> to_vector(Normal3<T> n) {
  return {n.x, n.y, n.z};
}
template <class T>
constexpr Normal3<T> to_normal(Vector3<T> v) {
  return {v.x, v.y, v.z};
}

// Returns whether all three components are finite.
template <class T>
bool is_finite(Point3<T> p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace vitrail
