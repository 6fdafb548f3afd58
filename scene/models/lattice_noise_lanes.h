// SPDX-License-Identifier: Apache-2.0
// lattice_noise.h for one instruction set: the corners of a face of a cell side by side. Every instruction
// set gives the same bits. All is inlined, and in an unnamed namespace, so that what is compiled for one is
// linked into no other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/geometry/vec.h"

#define VITRAIL_NOISE [[gnu::always_inline]] inline

namespace vitrail {
namespace {

// SplitMix64, of one number or of each of four.
template <class T>
VITRAIL_NOISE T mixed(T x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

namespace lattice {

// The corners (j, k), (j, k + 1), (j + 1, k), (j + 1, k + 1) of a face across x.
using Doubles = double __attribute__((vector_size(32)));
using Longs = std::uint64_t __attribute__((vector_size(32)));
using Pair = double __attribute__((vector_size(16)));

constexpr double greatest = 0x1p52;  // nothing lies between corners beyond it
// Of gradients, whose components are in ±1, over values in ±1; and what makes the deviation 0.117.
constexpr double of_gradients = 1.5, scale = 0.239;

VITRAIL_NOISE double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
template <class T>
VITRAIL_NOISE T mix(double t, T a, T b) {
  return (1 - t) * a + t * b;
}

VITRAIL_NOISE bool is_within(Point3d p) {
  return std::abs(p.x) < greatest && std::abs(p.y) < greatest && std::abs(p.z) < greatest;
}

// The cell of a coordinate, |x| < 2⁵², and where x is in it. Whole numbers below 0 are the ends of the cells
// before them, which gives the same noise. std::floor is a call without SSE4.1.
struct Coordinate {
  std::uint64_t cell;
  double rest;
};
VITRAIL_NOISE Coordinate coordinate_of(double x) {
  const std::int64_t cell = static_cast<std::int64_t>(x) - (x < 0);
  return {static_cast<std::uint64_t>(cell), x - static_cast<double>(cell)};
}

// Where a point is in its cell.
struct Place {
  std::uint64_t i, j, k;
  double dx, wx, wy, wz;  // w: faded
  Doubles dy, dz;         // from each corner
};
VITRAIL_NOISE Place place_of(Point3d p) {
  const Coordinate x = coordinate_of(p.x), y = coordinate_of(p.y), z = coordinate_of(p.z);
  return {x.cell,
          y.cell,
          z.cell,
          x.rest,
          fade(x.rest),
          fade(y.rest),
          fade(z.rest),
          y.rest - Doubles{0, 0, 1, 1},
          z.rest - Doubles{0, 1, 0, 1}};
}

// 2n − 1 of the numbers n whose 16 bits are the bits 36 … 51: as fractions of doubles in [2, 4), less 3.
// Exact.
VITRAIL_NOISE Doubles signed_numbers(Longs bits) {
  return reinterpret_cast<Doubles>((bits & 0x000ffff000000000u) | 0x4000000000000000u) - 3.0;
}

// What corners give, but for their distance along x: value, slope along x, and the shares of y and of z.
struct Face {
  Doubles value, slope, along_y, along_z;
};
VITRAIL_NOISE Face face_of(const Place& at, std::uint64_t i) {
  const std::uint64_t row = mixed(i), below = mixed(row + at.j), above = mixed(row + at.j + 1);
  const Longs bits = mixed(Longs{below, below, above, above} + (at.k + Longs{0, 1, 0, 1}));
  return {signed_numbers(bits >> 12), signed_numbers(bits << 36), signed_numbers(bits << 20) * at.dy,
          signed_numbers(bits << 4) * at.dz};
}
VITRAIL_NOISE Doubles corners(const Face& f, double dx) {
  return f.value + of_gradients * (f.slope * dx + f.along_y + f.along_z);
}

VITRAIL_NOISE double between(const Place& at, const Face& lower, const Face& upper) {
  const Doubles x = mix(at.wx, corners(lower, at.dx), corners(upper, at.dx - 1));
  const Pair y = mix(at.wy, Pair{x[0], x[1]}, Pair{x[2], x[3]});
  return std::clamp(scale * mix(at.wz, y[0], y[1]), -1.0, 1.0);
}

// lattice_noise
VITRAIL_NOISE double noise(Point3d p, std::uint64_t which) {
  if (!is_within(p)) return 0;
  const Place at = place_of(p);
  return between(at, face_of(at, at.i + which), face_of(at, at.i + which + 1));
}

// lattice_noises: the upper face of one is the lower face of the next.
VITRAIL_NOISE Vector3d noises(Point3d p) {
  if (!is_within(p)) return {};
  const Place at = place_of(p);
  const Face a = face_of(at, at.i), b = face_of(at, at.i + 1), c = face_of(at, at.i + 2),
             d = face_of(at, at.i + 3);
  return {between(at, a, b), between(at, b, c), between(at, c, d)};
}

}  // namespace lattice
}  // namespace
}  // namespace vitrail

#undef VITRAIL_NOISE
