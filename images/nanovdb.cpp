// SPDX-License-Identifier: Apache-2.0
#include "images/nanovdb.h"

#include <fmt/format.h>

#include <cmath>

#include "images/nanovdb_file.h"
#include "images/nanovdb_tree.h"

namespace vitrail {

namespace {

using namespace nanovdb_file;

// With one voxel more on each side.
VoxelBox box_of(const StoredGrid& grid, const File& file) {
  const auto& lower = grid.meta.indexBBox.min();
  const auto& upper = grid.meta.indexBBox.max();
  VoxelBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<nanovdb::Coord::IndexType>(k);
    if (lower[axis] > upper[axis]) file.fail("the grid has no active voxels");
    box.first[k] = std::int64_t{lower[axis]} - 1;
    box.last[k] = std::int64_t{upper[axis]} + 1;
    constexpr std::uint64_t most = 1u << 20;
    if (box.extent(k) > most)
      file.fail(fmt::format("the grid has {} voxels along an axis, more than {}", box.extent(k), most));
  }
  constexpr double most_cells = 1ull << 33;
  const double cells = static_cast<double>(box.extent(0)) * static_cast<double>(box.extent(1)) *
                       static_cast<double>(box.extent(2));
  if (cells > most_cells)
    file.fail(fmt::format("a box of {} × {} × {} voxels takes {:.0f} GiB; make its voxels larger",
                          box.extent(0), box.extent(1), box.extent(2), cells * sizeof(float) / (1u << 30)));
  return box;
}

Transform index_to_space(const StoredGrid& grid, const File& file) {
  const std::vector<char> bytes = unpacked(grid, sizeof(nanovdb::GridData), file);
  if (bytes.size() < sizeof(nanovdb::GridData)) file.fail("the file ends within a grid");
  nanovdb::Map map;
  std::memcpy(static_cast<void*>(&map), &bytes[offsetof(nanovdb::GridData, mMap)], sizeof map);
  Transform t;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = map.mMatD[3 * i + j];
    t.m[i][3] = map.mVecD[i];
  }
  for (const auto& row : t.m)
    for (const double entry : row)
      if (!std::isfinite(entry)) file.fail("the transform of the grid is not finite");
  if (!is_invertible(t)) file.fail("the transform of the grid has no inverse");
  return t;
}

bool keeps_axes(const Transform& t) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (i == j ? !(t.m[i][j] > 0) : t.m[i][j] != 0) return false;
  return true;
}

void require_floats(const StoredGrid& grid, const std::string& name, const File& file) {
  if (grid.meta.gridType != nanovdb::GridType::Float)
    file.fail(fmt::format("grid \"{}\" is not of 32-bit floats, which pbrt and Vitrail ask for", name));
}

}  // namespace

std::optional<NanoVdbGrid> read_nanovdb_header(const std::filesystem::path& path, const std::string& name) {
  const File file(path);
  const auto found = find_grid(file, name);
  if (!found) return {};
  require_floats(*found, name, file);
  const VoxelBox box = box_of(*found, file);
  NanoVdbGrid result;
  Grid& grid = result.grid;
  grid.filename = path.string();
  grid.field = name;
  grid.nx = static_cast<int>(box.extent(0));
  grid.ny = static_cast<int>(box.extent(1));
  grid.nz = static_cast<int>(box.extent(2));
  grid.edge = GridEdge::zero;
  const auto corner = [&](const std::array<std::int64_t, 3>& voxel, double by) {
    return Point3d{static_cast<double>(voxel[0]) + by, static_cast<double>(voxel[1]) + by,
                   static_cast<double>(voxel[2]) + by};
  };
  grid.bounds = {corner(box.first, -0.5), corner(box.last, 0.5)};
  const Transform to_space = index_to_space(*found, file);
  if (keeps_axes(to_space))
    grid.bounds = {transform_point(to_space, grid.bounds.lower),
                   transform_point(to_space, grid.bounds.upper)};
  else
    result.frame = to_space;
  return result;
}

std::vector<float> read_nanovdb_values(const Grid& grid) {
  const File file(grid.filename);
  const auto found = find_grid(file, grid.field);
  if (!found) file.fail(fmt::format("there is no grid \"{}\"", grid.field));
  require_floats(*found, grid.field, file);
  const VoxelBox box = box_of(*found, file);
  if (box.extent(0) != static_cast<std::uint64_t>(grid.nx) ||
      box.extent(1) != static_cast<std::uint64_t>(grid.ny) ||
      box.extent(2) != static_cast<std::uint64_t>(grid.nz))
    file.fail("the file has changed since its header was read");
  return dense_values(unpacked(*found, found->meta.gridSize, file), box, file);
}

}  // namespace vitrail
