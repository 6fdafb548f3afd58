// SPDX-License-Identifier: Apache-2.0
// Noise on the lattice of integers, the sum of value noise and gradient noise (Perlin, "An Image
// Synthesizer", 1985; the fade of "Improving Noise", 2002). Its numbers come from a hash (SplitMix64: Steele,
// Lea & Flood, "Fast Splittable Pseudorandom Number Generators", 2014), so it does not repeat. Its deviations
// and correlations are those that POV-Ray's pictures show: of `bozo`, 0.117 around a mean of 0.5, of which 57
// % are left half a unit away and 9 % a unit away.
#pragma once

#include <cstdint>

#include "scene/geometry/vec.h"

namespace vitrail {

// In [−1, 1], without a mean, of standard deviation 0.117. `which`: of independent ones. 0 where p is not
// finite, or beyond 2⁵².
double lattice_noise(Point3d p, std::uint64_t which = 0);
// Returns the noises of which = 0, 1 and 2, for less than three of them cost. The first is that of `bozo`, as
// POV-Ray's: moved by its own noise, `bozo` deviates by 4 % less and `wrinkles` by 7 %.
Vector3d lattice_noises(Point3d p);

// 0 … 1: of `bozo` and all that is as smooth.
double narrow_noise(Point3d p);
// 0 … 1, of twice the deviation: of what is summed over octaves.
double wide_noise(Point3d p);

// Four numbers in [0, 1) for a cell of the lattice.
struct CellNumbers {
  double x = 0, y = 0, z = 0, w = 0;
};
CellNumbers numbers_of_cell(std::int64_t i, std::int64_t j, std::int64_t k, std::uint64_t which);

// Σ omegaⁱ·noise(lambdaⁱ·p), i < octaves: of wide noise; of a vector of three noises of deviation 0.234.
struct Octaves {
  int count = 6;
  double lambda = 2, omega = 0.5;
};
double scalar_turbulence(Point3d p, const Octaves& octaves);
Vector3d vector_turbulence(Point3d p, const Octaves& octaves);

}  // namespace vitrail
