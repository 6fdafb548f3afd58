// SPDX-License-Identifier: Apache-2.0
// Grids of NanoVDB files (.nvdb, version 32), as pbrt-v4 takes them: of floats, by their names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/geometry/transform.h"
#include "scene/records/medium.h"

namespace vitrail {

// Where a grid stands in the file's space. Its bounds are there, where its axes are those of the space;
// `frame` is the identity then. Otherwise they are in the indices of its voxels, which `frame` places.
struct NanoVdbGrid {
  Grid grid;  // its values stay in the file; `field` is its name
  Transform frame;
};

// The box of the active voxels and one voxel more on each side, so that density falls to the background
// there: a voxel's value is that of its centre, which has whole indices, and linear in between. Nothing where
// the file has no grid of that name. Throws Error: a file of another kind or version, a grid that is not of
// floats or is compressed by Blosc, and what does not fit together.
std::optional<NanoVdbGrid> read_nanovdb_header(const std::filesystem::path& file, const std::string& name);

// The values of such a grid, x fastest. Memory: 4 bytes a cell of the box. Throws Error as above.
std::vector<float> read_nanovdb_values(const Grid& grid);

}  // namespace vitrail
