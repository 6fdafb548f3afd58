// SPDX-License-Identifier: Apache-2.0
// These are POV-Ray's noises, with the bumps where POV-Ray has them. Each is the sum of value noise and
// gradient noise on the lattice of integers (Perlin, "An Image Synthesizer", 1985): a corner has four of 267
// numbers, and a hash of 4096 entries says which. It repeats after 4096 units. Formulas and numbers are those
// that povray 3.7 shows by f_noise_generator(), vturbulence() and its patterns
// (scripts/generate_povray_noise.py; PovrayNoise in the tests holds them).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/records/pattern_texture.h"

namespace vitrail {

// Returns the noise of `bozo`, 0 … 1. All noises are 0 where p is not finite, or beyond 2⁵².
double pattern_noise(Point3d p, NoiseGenerator generator = NoiseGenerator::corrected);
// Returns a noise of twice the deviation, cut off at 0 and 1; the original generator gives the noise itself.
double wide_noise(Point3d p, NoiseGenerator generator);
// Returns three independent noises of mean 0. They are the same by both generators.
Vector3d vector_noise(Point3d p);

// Turbulence is Σ omegaⁱ·noise(lambdaⁱ·p), i < count. The scalar one sums wide noise, of which only the first
// is cut off.
struct Octaves {
  int count = 6;
  double lambda = 2, omega = 0.5;
};
double scalar_turbulence(Point3d p, const Octaves& octaves, NoiseGenerator generator);
Vector3d vector_turbulence(Point3d p, const Octaves& octaves);

// Returns the generator by the number that formulas have for it: 2 and above is the corrected one.
inline NoiseGenerator noise_generator(double number) {
  return number >= 2 ? NoiseGenerator::corrected : NoiseGenerator::original;
}

// They return Musgrave's sums of octaves ("Texturing and Modeling", 1994), of nine numbers as PatternStep::Op
// has them.
double ridged_multifractal(const double* numbers);
double hetero_multifractal(const double* numbers);

// Returns three random numbers in [0, 1) that belong to a unit cell.
std::span<const double, 3> numbers_of_cell(std::int64_t i, std::int64_t j, std::int64_t k);

// `ripples` and `waves` come from such points, 1 away from the origin. `frequency` counts the waves of one in
// a unit of length.
struct WaveSource {
  Vector3d place;
  double frequency = 1;
};
inline constexpr std::size_t wave_source_count = 10;
const WaveSource& wave_source(std::size_t i);

}  // namespace vitrail
