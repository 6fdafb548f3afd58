// SPDX-License-Identifier: Apache-2.0
// The tree of a NanoVDB grid of floats has a root of tiles, 32³ nodes, 16³ nodes, and leaves of 8³ voxels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "images/nanovdb_file.h"

namespace vitrail::nanovdb_file {

// It bounds voxels by their indices; both ends belong to it.
struct VoxelBox {
  std::array<std::int64_t, 3> first{}, last{};
  std::uint64_t extent(std::size_t axis) const {
    return static_cast<std::uint64_t>(last[axis] - first[axis] + 1);
  }
};

// Returns all voxels of the box, x fastest: values of leaves, of tiles, else the background. `grid` is its
// bytes as they lie in memory. Each offset in them is checked; where one leads out of them, it throws Error
// by `file`.
std::vector<float> dense_values(std::span<const char> grid, const VoxelBox& box, const File& file);

}  // namespace vitrail::nanovdb_file
