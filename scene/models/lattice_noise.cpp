// SPDX-License-Identifier: Apache-2.0
#include "scene/models/lattice_noise.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

constexpr double greatest = 0x1p52;  // nothing lies between corners beyond it
// Of gradients, whose components are in ±1, over values in ±1; and what makes the deviation 0.117.
constexpr double of_gradients = 1.5, scale = 0.239;

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

std::uint64_t hash(std::int64_t i, std::int64_t j, std::int64_t k, std::uint64_t which) {
  return mixed(mixed(mixed(static_cast<std::uint64_t>(i) + which) + static_cast<std::uint64_t>(j)) +
               static_cast<std::uint64_t>(k));
}

double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
double mix(double t, double a, double b) { return (1 - t) * a + t * b; }

bool is_within(Point3d p) {
  return std::abs(p.x) < greatest && std::abs(p.y) < greatest && std::abs(p.z) < greatest;
}

// Calls f(weight, point) for every octave.
template <class F>
void for_octaves(Point3d p, const Octaves& octaves, F&& f) {
  double weight = 1, frequency = 1;
  for (int i = 0; i < octaves.count; ++i, weight *= octaves.omega, frequency *= octaves.lambda)
    f(weight, Point3d{p.x * frequency, p.y * frequency, p.z * frequency});
}

}  // namespace

CellNumbers numbers_of_cell(std::int64_t i, std::int64_t j, std::int64_t k, std::uint64_t which) {
  const std::uint64_t bits = hash(i, j, k, which);
  const auto number = [&](int place) { return static_cast<double>(bits >> 16 * place & 0xffffu) * 0x1p-16; };
  return {number(0), number(1), number(2), number(3)};
}

double lattice_noise(Point3d p, std::uint64_t which) {
  if (!is_within(p)) return 0;
  const double x = std::floor(p.x), y = std::floor(p.y), z = std::floor(p.z);
  const double dx = p.x - x, dy = p.y - y, dz = p.z - z;
  const auto corner = [&](int i, int j, int k) {
    const CellNumbers n = numbers_of_cell(static_cast<std::int64_t>(x) + i, static_cast<std::int64_t>(y) + j,
                                          static_cast<std::int64_t>(z) + k, which);
    const double gradient = (2 * n.x - 1) * (dx - i) + (2 * n.y - 1) * (dy - j) + (2 * n.z - 1) * (dz - k);
    return 2 * n.w - 1 + of_gradients * gradient;
  };
  const double wx = fade(dx), wy = fade(dy), wz = fade(dz);
  const auto along_x = [&](int j, int k) { return mix(wx, corner(0, j, k), corner(1, j, k)); };
  const auto along_y = [&](int k) { return mix(wy, along_x(0, k), along_x(1, k)); };
  return std::clamp(scale * mix(wz, along_y(0), along_y(1)), -1.0, 1.0);
}

double narrow_noise(Point3d p) { return std::clamp(0.5 + lattice_noise(p), 0.0, 1.0); }
double wide_noise(Point3d p) { return std::clamp(0.5 + 2 * lattice_noise(p), 0.0, 1.0); }

double scalar_turbulence(Point3d p, const Octaves& octaves) {
  double sum = 0;
  for_octaves(p, octaves, [&](double weight, Point3d q) { sum += weight * wide_noise(q); });
  return sum;
}

Vector3d vector_turbulence(Point3d p, const Octaves& octaves) {
  Vector3d sum;
  for_octaves(p, octaves, [&](double weight, Point3d q) {
    sum = sum + Vector3d{lattice_noise(q, 1), lattice_noise(q, 2), lattice_noise(q, 3)} * (2 * weight);
  });
  return sum;
}

}  // namespace vitrail
