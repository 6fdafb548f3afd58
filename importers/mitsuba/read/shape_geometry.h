// SPDX-License-Identifier: Apache-2.0
// These functions make the triangles of each kind of shape.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

struct ShapeGeometry {
  Id<TriangleMesh> mesh;
  Transform mesh_to_object = {};  // the object's space is what `to_world` starts from
  // Mitsuba's front is where the shading normals point, which keep their side under mirrors; otherwise it is
  // where the triangles run counter-clockwise in the world.
  bool front_by_normals = false;
  bool in_world = false;  // `to_world` is in the mesh
  // They are set for an obj that is given several bsdfs by name (0.6): the usemtl of its faces, and the bsdf
  // of that name.
  std::optional<std::string> part = {};
  const Property* bsdf = nullptr;
};

// Returns the object's type; scenes in use also say "Sphere" and "Rectangle".
std::string kind_of(const Object& shape);

// It makes rectangle, disk, cube, sphere and cylinder; nothing for other kinds.
std::optional<ShapeGeometry> analytic_shape(Builder& builder, const Object& shape);
// It reads obj, ply and serialized. It returns one, but for an obj whose faces have bsdfs by name; none for
// other kinds.
std::vector<ShapeGeometry> shapes_of_file(Builder& builder, const Object& shape);
// It makes linearcurve, bsplinecurve, and hair of 0.6.
std::optional<ShapeGeometry> curve_shape(Builder& builder, const Object& shape);
// It makes sdfgrid.
std::optional<ShapeGeometry> distance_shape(Builder& builder, const Object& shape);
// It makes heightfield of 0.6.
std::optional<ShapeGeometry> height_shape(Builder& builder, const Object& shape);

// Returns the mesh under this key, which it makes where it is not there yet. An Error that it throws without
// a place gets that of the object. Where there is a way to make it `again`, it need not stay in memory.
using MeshKey = std::tuple<std::string, int, int>;
Id<TriangleMesh> shared_mesh(Builder& builder, const Object& shape, const MeshKey& key,
                             const std::function<TriangleMesh()>& make, MeshLoader again = {});

// Returns whether the shape names a file that is not there.
bool lacks_its_file(const Object& shape);
// Returns the file of the object's parameter "filename"; throws Error where there is no such regular file.
std::filesystem::path shape_file(Builder& builder, const Object& shape);

}  // namespace vitrail::mitsuba
