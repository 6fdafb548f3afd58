// SPDX-License-Identifier: Apache-2.0
// These functions look up a Grid of scene/records/medium.h.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/records/medium.h"

namespace vitrail {

// Interpolates trilinearly between the centres of the cells; p is in the medium's space.
// `channel` < grid.channels.
double look_up(const Grid& grid, Point3d p, int channel);

// It looks up a baked grid of colours (partitioner/appearance/bake_media.h) at wavelengths, over the eight
// cells around p. The result is Σ wᵢ·Sᵢ(λ) times Σ wᵢ·scaleᵢ, as in Mitsuba 3.9 (measured). A grid that is 0
// outside gives Σ wᵢ·scaleᵢ·Sᵢ(λ), as in pbrt-v4.
// A grid of three channels has bands (scene/spectra/rgb_bands.h): it gives Σ wᵢ times the wavelength's band.
inline constexpr int color_channels = 4, band_channels = 3;
inline bool has_colors(const Grid& grid) { return grid.channels >= band_channels; }
void look_up_colors(const Grid& grid, Point3d p, std::span<const double> lambda_nm, std::span<double> values);

// Returns a value that no value of the grid exceeds, at any wavelength.
double greatest_value(const Grid& grid);

struct GridRange {
  float low = 0, high = 0;
};
// They are planes across the axes x, y and z, at least two of each, in ascending order.
using Planes = std::array<std::vector<double>, 3>;
// Returns a range for each box between successive planes, x fastest. It holds every value that a look-up in
// the box gives, at any wavelength. The values of the grid are ≥ 0. Each of its cells is read once.
std::vector<GridRange> value_ranges(const Grid& grid, const Planes& planes);

}  // namespace vitrail
