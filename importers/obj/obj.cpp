// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/obj.h"

#include "importers/obj/obj_parser.h"
#include "importers/obj/obj_scene.h"

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

}  // namespace

ImportedScene read_obj(const std::filesystem::path& file) {
  InputBytes bytes(file);
  const std::string name = file.string();
  obj::ParseOptions options;
  std::optional<obj::Geometry> geometry = obj::parse(bytes, name, options);
  if (!geometry) {
    options.base = 0;
    geometry = obj::parse(bytes, name, options);
  }
  options.offset = offset_of(geometry->bounds);
  if (options.offset != Vector3d{}) {
    geometry.reset();
    geometry = obj::parse(bytes, name, options);
  }
  bytes.release_before(bytes.end());
  return obj::to_scene(std::move(*geometry), options.offset, file);
}

}  // namespace vitrail
