// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "importers/bytes/growing_array.h"
#include "importers/bytes/input_bytes.h"
#include "importers/obj/read/obj_group.h"
#include "scene/geometry/bounds.h"
#include "scene/records/scene.h"

namespace vitrail::obj {

// A name in the file and where it stands first.
struct Mention {
  std::string name;
  SourceLocation location;
};

struct ParseOptions {
  int base = 1;               // of vertex indices: 1 or 0
  Vector3d offset;            // is subtracted from positions while they are doubles
  bool one_material = false;  // usemtl means nothing
  bool bare = false;          // nor do smoothing groups and colours of vertices
};

struct Geometry {
  GrowingArray<Point3f> positions;
  GrowingArray<Point2f> uvs;
  GrowingArray<Normal3f> normals;
  std::vector<float> colors;       // red, green, blue of the first positions, linear; white behind them
  Bounds3d bounds;                 // of the positions in the file
  std::vector<Group> groups;       // in the order of their first face
  std::vector<Mention> materials;  // of usemtl; the first stands for faces without one
  std::vector<Mention> libraries;  // what follows each mtllib
  Diagnostics diagnostics;
};

// Nothing if indices count from 1 and a face has vertex index 0. The result does not depend on the number of
// threads. Throws Error.
std::optional<Geometry> parse(InputBytes& bytes, const std::string& file, const ParseOptions& options);

}  // namespace vitrail::obj
