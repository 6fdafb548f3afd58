// SPDX-License-Identifier: Apache-2.0
// These values are computed from a point: Perlin's noise and what pbrt makes of it (Pharr, Jakob and
// Humphreys, "Physically Based Rendering", 4th ed. 2023, section 10.6 online and the 3rd ed., section 10.6).
// All octaves count, whatever the footprint. pbrt leaves parts of them out below its footprint. This part
// goes to nothing as samples make the footprint small, and samples average what pbrt would leave out.
#pragma once

#include <array>

#include "scene/records/texture.h"

namespace vitrail {

// Returns gradient noise with Perlin's permutation ("Improving Noise", 2002) and pbrt's choice of twelve
// gradients for sixteen hashes. It is 0 at points of integers, within [−1, 1], and repeats every 256 units.
double perlin_noise(Point3d p);

// Returns Σ omegaⁱ·noise(1.99ⁱ·p), i < octaves.
double fractal_noise(Point3d p, double omega, int octaves);

// Returns the same sum of |noise|, with 0.2·omega^octaves for the octaves that follow.
double turbulence(Point3d p, double omega, int octaves);

// Returns the value of fbm, wrinkled or windy at a point of texture space.
double noise_value(const NoiseTexture& texture, Point3d p);

// Marble is a blend of four colours. The function returns how much of each there is at a point of texture
// space; the sum is 1.
inline constexpr std::size_t marble_color_count = 4;
std::array<double, marble_color_count> marble_weights(const NoiseTexture& texture, Point3d p);
// They are pbrt's colours, already brightened by its 1.5, as `reflectance_from_rgb` fits them.
extern const std::array<SigmoidSpectrum, marble_color_count> marble_colors;

// Returns whether a point in (s,t) is inside of one of pbrt's dots: discs of radius 0.35 in 39 % of the
// cells.
bool inside_dot(double s, double t);

}  // namespace vitrail
