// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/density_files.h"

#include <cmath>
#include <span>

#include "importers/writing/medium_grids.h"
#include "importers/writing/mesh_files.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail::povray {

namespace {

constexpr int most_cells = 65535;

// Three sizes and the values of a channel, in two bytes each, the higher one first.
std::string df3(const Grid& grid, std::size_t channel, double greatest) {
  const auto channels = static_cast<std::size_t>(grid.channels);
  std::string bytes;
  bytes.reserve(6 + 2 * grid.values.size() / channels);
  const auto put = [&](unsigned number) {
    bytes += static_cast<char>(number >> 8 & 255);
    bytes += static_cast<char>(number & 255);
  };
  for (const int size : {grid.nx, grid.ny, grid.nz}) put(static_cast<unsigned>(size));
  for (std::size_t i = channel; i < grid.values.size(); i += channels)
    put(static_cast<unsigned>(
        std::lround(std::max(0.0, static_cast<double>(grid.values[i])) / greatest * 65535)));
  return bytes;
}

// Of n cells POV-Ray shows cell i at i/n of its unit cube: the cube begins at the centre of the first.
Transform cube_to_grid(const Grid& grid) {
  const Vector3d size = grid.bounds.upper - grid.bounds.lower,
                 half{size.x / grid.nx / 2, size.y / grid.ny / 2, size.z / grid.nz / 2};
  return translate(grid.bounds.lower + half - Point3d{}) * scale(size);
}

}  // namespace

std::vector<DensityPart> density_parts(Context& context, const Grid& grid, const Transform& medium_to_world) {
  // Behind the last cell POV-Ray goes on with the first: both are of the layer around.
  const Grid wide = with_cells_around(with_values(grid), grid.edge == GridEdge::zero);
  if (std::max({wide.nx, wide.ny, wide.nz}) > most_cells)
    throw Error("a grid of more than 65535 cells along a side");
  const std::string place = matrix(context.units.to_pov * medium_to_world * cube_to_grid(wide));
  std::vector<DensityPart> parts;
  for (std::size_t channel = 0; channel < static_cast<std::size_t>(wide.channels); ++channel) {
    double greatest = 0;
    for (std::size_t i = channel; i < wide.values.size(); i += static_cast<std::size_t>(wide.channels))
      greatest = std::max(greatest, static_cast<double>(wide.values[i]));
    if (!(greatest > 0)) continue;
    std::filesystem::path file = context.images.new_file();
    file.replace_extension(".df3");
    AtomicFile out(file);
    const std::string bytes = df3(wide, channel, greatest);
    out.write(std::as_bytes(std::span(bytes)));
    out.commit();
    RGB color{greatest, greatest, greatest};
    if (wide.channels > 1)
      color = {channel == 0 ? greatest : 0, channel == 1 ? greatest : 0, channel == 2 ? greatest : 0};
    parts.push_back(
        {fmt::format("density {{ density_file df3 {} interpolate 1\n    color_map {{ [0 rgb 0] [1 rgb "
                     "1] }} {} }}",
                     quoted(relative_name(file.string(), context.directory)), place),
         color});
  }
  return parts;
}

}  // namespace vitrail::povray
