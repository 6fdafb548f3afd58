// SPDX-License-Identifier: Apache-2.0
// The tree of a NanoVDB grid of floats: a root of tiles, 32³ nodes, 16³ nodes, leaves of 8³ voxels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "images/nanovdb_file.h"

namespace vitrail::nanovdb_file {

// Voxels by their indices, both ends included.
struct VoxelBox {
  std::array<std::int64_t, 3> first{}, last{};
  std::uint64_t extent(std::size_t axis) const {
    return static_cast<std::uint64_t>(last[axis] - first[axis] + 1);
  }
};

// All voxels of the box, x fastest: of leaves, of tiles, else the background. `grid`: its bytes as they lie
// in memory. Each offset in them is checked; throws Error by the file where one leads out of them.
std::vector<float> dense_values(std::span<const char> grid, const VoxelBox& box, const File& file);

}  // namespace vitrail::nanovdb_file
