// SPDX-License-Identifier: Apache-2.0
// Surfaces of signed distances on a grid.
#include <fmt/format.h>

#include <cmath>

#include "importers/mitsuba/read/shape_geometry.h"
#include "importers/mitsuba/read/volume_file.h"
#include "importers/shapes/level_set.h"
#include "scene/system/input_files.h"

namespace vitrail::mitsuba {

namespace {

SampledFunction read_distances(const std::filesystem::path& path) {
  Grid grid;
  try {
    grid = read_volume_header(path);
  } catch (const std::runtime_error& error) {
    throw Error(error.what(), {path.string()});
  }
  if (grid.channels != 1 || grid.nx < 2 || grid.ny < 2 || grid.nz < 2)
    throw Error("signed distances need one channel and two values along each side", {path.string()});
  SampledFunction f{grid.nx, grid.ny, grid.nz, {}};
  f.values.resize(static_cast<std::size_t>(f.nx) * static_cast<std::size_t>(f.ny) *
                  static_cast<std::size_t>(f.nz));
  std::ifstream file = open_input(path);
  file.seekg(volume_header_bytes);
  file.read(reinterpret_cast<char*>(f.values.data()),
            static_cast<std::streamsize>(f.values.size() * sizeof(float)));
  if (!file) throw Error("the file ends before its values do", {path.string()});
  for (const float value : f.values)
    if (!std::isfinite(value)) throw Error("a signed distance is not finite", {path.string()});
  return f;
}

}  // namespace

// The grid fills [0,1]³ of the object's space.
std::optional<ShapeGeometry> distance_shape(Builder& builder, const Object& shape) {
  if (kind_of(shape) != "sdfgrid") return std::nullopt;
  const std::filesystem::path path = shape_file(builder, shape);
  shape.ignore({"normals", "watertight"});
  double distance = 0;
  const Id<TriangleMesh> mesh = shared_mesh(builder, shape, {path.string(), 0, 0}, [&] {
    LevelSet made = level_set(read_distances(path));
    distance = made.distance;
    made.mesh.missing_uv = MissingUv::zero;  // measured: Mitsuba has (0,0) everywhere
    return std::move(made.mesh);
  });
  builder.report.approximated(
      distance > 0
          ? fmt::format(
                "the surface of signed distances becomes triangles, at most {:.2g} of the grid's size "
                "from it",
                distance)
          : "the surface of signed distances becomes triangles",
      shape.origin);
  return ShapeGeometry{mesh, {}, false};
}

}  // namespace vitrail::mitsuba
