// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj.h"

#include "importers/obj/read/obj_meshes.h"
#include "importers/obj/read/obj_parser.h"
#include "importers/obj/read/obj_scene.h"

namespace vitrail {

namespace {

// Where a file's coordinates are much larger than its extent, floats would not hold its shape: what to
// subtract.
Vector3d offset_of(const Bounds3d& bounds) {
  constexpr double far = 16;  // distance over half extent: four bits lost
  if (bounds.empty()) return {};
  const Vector3d away = center(bounds) - Point3d{}, half = extent(bounds) * 0.5;
  const bool is_far = length(away) > far * length(half) && length(half) > 0;
  return is_far ? cast<double>(cast<float>(away)) : Vector3d{};
}

// Counts from 0 where the file does.
obj::Geometry parse(InputBytes& bytes, const std::string& name, obj::ParseOptions& options) {
  std::optional<obj::Geometry> geometry = obj::parse(bytes, name, options);
  if (geometry) return std::move(*geometry);
  options.base = 0;
  return std::move(obj::parse(bytes, name, options).value());
}

}  // namespace

ImportedScene read_obj(const std::filesystem::path& file) {
  InputBytes bytes(file);
  obj::ParseOptions options;
  obj::Geometry geometry = parse(bytes, file.string(), options);
  options.offset = offset_of(geometry.bounds);
  if (options.offset != Vector3d{}) {
    geometry = {};
    geometry = parse(bytes, file.string(), options);
  }
  bytes.release_before(bytes.end());
  return obj::to_scene(std::move(geometry), options.offset, file);
}

ObjGeometry read_obj_geometry(const std::filesystem::path& file, bool by_material) {
  InputBytes bytes(file);
  obj::ParseOptions options;
  options.one_material = !by_material;
  options.bare = true;
  obj::Geometry geometry = parse(bytes, file.string(), options);
  bytes.release_before(bytes.end());
  Diagnostics diagnostics = std::move(geometry.diagnostics);
  std::vector<std::string> materials;
  for (const obj::Group& group : geometry.groups)
    materials.push_back(geometry.materials[group.material].name);
  return {obj::to_meshes(std::move(geometry)), std::move(materials), std::move(diagnostics)};
}

}  // namespace vitrail
