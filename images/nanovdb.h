// SPDX-License-Identifier: Apache-2.0
// These functions read grids of NanoVDB files (.nvdb, version 32) as pbrt-v4 does: grids of floats, by their
// names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/geometry/transform.h"
#include "scene/records/medium.h"

namespace vitrail {

// It holds where a grid is in the file's space. Where the grid's axes are those of the space, the bounds are
// in the space and `frame` is the identity. Otherwise they are in voxel indices, which `frame` places.
struct NanoVdbGrid {
  Grid grid;  // its values stay in the file; `field` is its name
  Transform frame;
};

// Returns the box of the active voxels and one voxel more on each side, so that density falls to the
// background there. A voxel's value is that of its centre, which has whole indices, and linear in between.
// Returns nothing where the file has no grid of that name. Throws Error for a file of another kind or
// version, a grid that is not of floats or is compressed by Blosc, and parts that do not fit together.
std::optional<NanoVdbGrid> read_nanovdb_header(const std::filesystem::path& file, const std::string& name);

// Returns the values of such a grid, x fastest. It takes 4 bytes of memory a cell of the box. Throws Error as
// read_nanovdb_header does.
std::vector<float> read_nanovdb_values(const Grid& grid);

}  // namespace vitrail
