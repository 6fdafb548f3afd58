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

// It is a name in the file and where it stands first.
struct Mention {
  std::string name;
  SourceLocation location;
};

// It has the names that o and g give to the faces that follow.
struct Object {
  std::string o, g;
  SourceLocation location;  // of the statement
};

// It holds what statements say of the faces that follow them: indices of Geometry's.
struct Use {
  std::size_t object = 0, material = 0;
};

struct ParseOptions {
  int base = 1;               // of vertex indices: 1 or 0
  Vector3d offset;            // is subtracted from positions while they are doubles
  bool one_material = false;  // usemtl means nothing
  bool bare = false;          // nor do objects, smoothing groups and colours of vertices
};

struct Geometry {
  GrowingArray<Point3f> positions;
  GrowingArray<Point2f> uvs;
  GrowingArray<Normal3f> normals;
  std::vector<float> colors;  // red, green, blue of the first positions, linear; white behind them
  Bounds3d bounds;            // of the positions in the file
  // Groups of one material and kind follow one another, otherwise they are in the order of their first face.
  std::vector<Group> groups;
  std::vector<Mention> materials;  // of usemtl; the first stands for faces without one
  std::vector<Object> objects;     // the first stands for faces before any o or g
  std::vector<Use> uses;
  bool several_named = false;      // o has several names
  std::vector<Mention> libraries;  // what follows each mtllib
  Diagnostics diagnostics;
};

// More objects than these are one: each takes about 2 kB while the file is read, and its own mesh.
inline constexpr std::size_t most_objects = 20'000;

// Returns the name of an object: by o where the file has several of those, else by g where there is one.
// (Programs write one o for all and a g for each object, or an o for each and a g for parts of them.)
std::string name_of(const Object& object, const Geometry& geometry);

// Returns nothing if indices count from 1 and a face has vertex index 0. The result does not depend on the
// number of threads. Throws Error.
std::optional<Geometry> parse(InputBytes& bytes, const std::string& file, const ParseOptions& options);

}  // namespace vitrail::obj
