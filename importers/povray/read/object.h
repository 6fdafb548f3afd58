// SPDX-License-Identifier: Apache-2.0
// These records hold objects as scenes say them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "importers/povray/read/surface.h"
#include "importers/povray/read/surface_uvs.h"
#include "importers/solids/csg.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/mesh.h"

namespace vitrail::pov {

class TriangleTree;

struct SphereShape {
  Point3d center;
  double radius = 1;
};
struct BoxShape {
  Point3d corner1, corner2;
};
struct PlaneShape {
  Vector3d normal;
  double distance = 0;
};
// It holds cylinders, too: those have equal radii.
struct ConeShape {
  Point3d base, cap;
  double base_radius = 1, cap_radius = 0;
  bool open = false;
};
struct DiscShape {
  Point3d center;
  Vector3d normal;
  double radius = 1, hole_radius = 0;
};
// It has triangles: a part for each texture, and one of those that have the object's.
struct MeshShape {
  struct Part {
    Shared<Texture> texture;
    std::shared_ptr<const TriangleMesh> mesh;
  };
  std::vector<Part> parts;
  bool closed = false;     // has an inside (inside_vector)
  bool clockwise = false;  // seen from its outside the corners run clockwise
  bool has_uvs = true;     // else those are the world's x and y
};
// It is a shape of importers/solids, made where it is needed.
struct SolidShape {
  std::function<solids::Solid()> make;
  std::optional<solids::Unbounded> unbounded;  // in place of it
  std::function<bool(Point3d)> inside;         // where a formula says it; else its triangles do
  std::optional<Bounds3d> box;  // what POV-Ray takes for its extents; else those of what is made
  bool patch = false;           // encloses nothing; seen from its outside the corners run clockwise
  SurfaceUvs uvs{};
};
struct GroupShape {
  Word kind = Word::union_;  // union_, merge_, intersection_, difference_, light_group_
};
struct LightShape {
  enum class Kind { point, spot, cylinder };
  Kind kind = Kind::point;
  Point3d position;
  Numbers color = Finish::grey(1);
  bool parallel = false, shadowless = false, area = false, circular = false;
  Point3d point_at;
  double radius_deg = 30, falloff_deg = 45, tightness = 0;
  Vector3d axis1, axis2;
  int count1 = 1, count2 = 1;
  double fade_distance = 0, fade_power = 0;
  bool projected = false, attenuated = false;
};

struct Object {
  int levels = 1;
  Place place;
  std::variant<SphereShape, BoxShape, PlaneShape, ConeShape, DiscShape, MeshShape, SolidShape, GroupShape,
               LightShape>
      shape = GroupShape{};
  std::vector<Shared<Object>> children;  // of a group; of a light, what it looks like
  Transform to_parent;
  Shared<Texture> texture, interior_texture;
  Shared<Interior> interior;
  std::vector<Shared<Object>> clipped_by;
  bool inverse = false, no_shadow = false, no_image = false, hollow = false, uv_mapping = false;
  bool no_reflection = false, no_radiosity = false, double_illuminate = false;
  bool declared = false;                             // an identifier stands for it
  bool refers = false;                               // a copy of its only child, which is declared
  mutable std::optional<Bounds3d> box;               // of the shape, once it was asked for (extents.h)
  mutable std::shared_ptr<const TriangleTree> tree;  // of the shape, once trace() asked (shape_hits.h)
  Shared<Object> original;  // of a copy: what its shape was made as, so that both share it
};

}  // namespace vitrail::pov
