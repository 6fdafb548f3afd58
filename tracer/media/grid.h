// SPDX-License-Identifier: Apache-2.0
// Looking up a scene/records/medium.h Grid.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/records/medium.h"

namespace vitrail {

// Trilinear between the centres of the cells; p in the medium's space. `channel` < grid.channels.
double look_up(const Grid& grid, Point3d p, int channel);

// A baked grid of colours (partitioner/appearance/bake_media.h) at wavelengths: Σ wᵢ·Sᵢ(λ) times Σ wᵢ·scaleᵢ,
// over the eight cells around p, as Mitsuba 3.9 has it (measured); Σ wᵢ·scaleᵢ·Sᵢ(λ), as pbrt-v4, of one that
// is 0 outside.
// A grid of three channels is of bands (scene/spectra/rgb_bands.h): Σ wᵢ times that of the wavelength.
inline constexpr int color_channels = 4, band_channels = 3;
inline bool has_colors(const Grid& grid) { return grid.channels >= band_channels; }
void look_up_colors(const Grid& grid, Point3d p, std::span<const double> lambda_nm, std::span<double> values);

// No value of the grid is greater, at any wavelength.
double greatest_value(const Grid& grid);

struct ValueRange {
  float low = 0, high = 0;
};
// Planes across the axes x, y and z, at least two of each, in ascending order.
using Planes = std::array<std::vector<double>, 3>;
// For each box between successive planes, x fastest, a range that holds every value that a look-up in it
// gives, at any wavelength. The values of the grid are ≥ 0. Each of its cells is read once.
std::vector<ValueRange> value_ranges(const Grid& grid, const Planes& planes);

}  // namespace vitrail
