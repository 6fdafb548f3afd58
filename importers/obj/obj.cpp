// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/obj.h"

#include "importers/obj/obj_parser.h"
#include "importers/obj/obj_scene.h"

namespace vitrail {

ImportedScene read_obj(const std::filesystem::path& file) {
  InputBytes bytes(file);
  const std::string name = file.string();
  obj::Geometry geometry;
  if (!obj::parse(bytes, name, 1, geometry)) {
    geometry = {};
    obj::parse(bytes, name, 0, geometry);
  }
  return obj::to_scene(std::move(geometry), file);
}

}  // namespace vitrail
