// SPDX-License-Identifier: Apache-2.0
#include "scene/models/lattice_noise.h"

#include <algorithm>

#include "scene/models/lattice_noise_lanes.h"

namespace vitrail {

namespace {

std::uint64_t hash(std::int64_t i, std::int64_t j, std::int64_t k, std::uint64_t which) {
  return mixed(mixed(mixed(static_cast<std::uint64_t>(i) + which) + static_cast<std::uint64_t>(j)) +
               static_cast<std::uint64_t>(k));
}

// Calls f(weight, point) for every octave.
template <class F>
void for_octaves(Point3d p, const Octaves& octaves, F&& f) {
  double weight = 1, frequency = 1;
  for (int i = 0; i < octaves.count; ++i, weight *= octaves.omega, frequency *= octaves.lambda)
    f(weight, Point3d{p.x * frequency, p.y * frequency, p.z * frequency});
}

double noise_portable(Point3d p, std::uint64_t which) { return lattice::noise(p, which); }
Vector3d noises_portable(Point3d p) { return lattice::noises(p); }

// The same bits.
#if defined(__x86_64__)
[[gnu::target("avx2")]] double noise_avx2(Point3d p, std::uint64_t which) { return lattice::noise(p, which); }
[[gnu::target("avx2")]] Vector3d noises_avx2(Point3d p) { return lattice::noises(p); }
const bool has_avx2 = __builtin_cpu_supports("avx2");
const auto chosen_noise = has_avx2 ? noise_avx2 : noise_portable;
const auto chosen_noises = has_avx2 ? noises_avx2 : noises_portable;
#else
constexpr auto chosen_noise = noise_portable;
constexpr auto chosen_noises = noises_portable;
#endif

}  // namespace

CellNumbers numbers_of_cell(std::int64_t i, std::int64_t j, std::int64_t k, std::uint64_t which) {
  const std::uint64_t bits = hash(i, j, k, which);
  const auto number = [&](int place) { return static_cast<double>(bits >> 16 * place & 0xffffu) * 0x1p-16; };
  return {number(0), number(1), number(2), number(3)};
}

double lattice_noise(Point3d p, std::uint64_t which) { return chosen_noise(p, which); }
Vector3d lattice_noises(Point3d p) { return chosen_noises(p); }

// Askew in its lattice POV-Ray's noise deviates by 0.126; along the lattice, as its normals were measured, by
// 0.117.
constexpr double askew = 1.076;
double narrow_noise(Point3d p) { return std::clamp(0.5 + askew * lattice_noise(p), 0.0, 1.0); }
double wide_noise(Point3d p) { return std::clamp(0.5 + 2 * askew * lattice_noise(p), 0.0, 1.0); }

double scalar_turbulence(Point3d p, const Octaves& octaves) {
  double sum = 0;
  for_octaves(p, octaves, [&](double weight, Point3d q) { sum += weight * wide_noise(q); });
  return sum;
}

Vector3d vector_turbulence(Point3d p, const Octaves& octaves) {
  Vector3d sum;
  for_octaves(p, octaves, [&](double weight, Point3d q) { sum = sum + lattice_noises(q) * (2 * weight); });
  return sum;
}

}  // namespace vitrail
