// SPDX-License-Identifier: Apache-2.0
// Mitsuba's analytic shapes, with its (u,v).
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "importers/mitsuba/read/shape_geometry.h"
#include "importers/shapes/quadrics.h"
#include "scene/geometry/frame.h"

namespace vitrail::mitsuba {

namespace {

// [-1,1]² at z = 0, facing +z.
TriangleMesh rectangle() {
  TriangleMesh mesh;
  for (const auto& [x, y] : {std::pair{-1.f, -1.f}, {1.f, -1.f}, {1.f, 1.f}, {-1.f, 1.f}}) {
    mesh.positions.push_back({x, y, 0});
    mesh.normals.push_back({0, 0, 1});
    mesh.uvs.push_back({(x + 1) / 2, (y + 1) / 2});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// [-1,1]³. Every face begins at its (u,v) = (0,1), u grows along the first axis and v falls along the second.
TriangleMesh cube() {
  struct Face {
    Point3f corner;
    Vector3f u, v;
  };
  constexpr Face faces[] = {{{1, -1, -1}, {0, 0, 2}, {-2, 0, 0}}, {{1, 1, -1}, {-2, 0, 0}, {0, 0, 2}},
                            {{1, -1, -1}, {0, 2, 0}, {0, 0, 2}},  {{1, -1, 1}, {0, 2, 0}, {-2, 0, 0}},
                            {{-1, -1, 1}, {0, 2, 0}, {0, 0, -2}}, {{1, 1, -1}, {0, -2, 0}, {-2, 0, 0}}};
  TriangleMesh mesh;
  for (const Face& face : faces) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Normal3f normal = to_normal(cross(face.u, face.v) * 0.25f);
    for (const Point3f p :
         {face.corner, face.corner + face.u, face.corner + face.u + face.v, face.corner + face.v}) {
      mesh.positions.push_back(p);
      mesh.normals.push_back({normal.x + 0.f, normal.y + 0.f, normal.z + 0.f});
    }
    mesh.uvs.insert(mesh.uvs.end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first + 3, first, first + 2});
  }
  return mesh;
}

TriangleMesh sphere() { return mesh_of({.kind = QuadricKind::sphere, .uv = QuadricUv::mitsuba}); }
TriangleMesh disk() { return mesh_of({.kind = QuadricKind::disk, .uv = QuadricUv::mitsuba, .low = 0}); }
TriangleMesh cylinder() { return mesh_of({.kind = QuadricKind::cylinder}); }

double radius_of(Builder& builder, const Object& shape) {
  const double radius = shape.number("radius", 1, builder.report);
  if (radius > 0 && std::isfinite(radius)) return radius;
  const Property* property = shape.find("radius");
  builder.report.fail(fmt::format("the radius is {}, but has to be finite and above 0", radius),
                      property ? property->origin : shape.origin);
}

Vector3d point(Builder& builder, const Object& shape, std::string_view name, Vector3d otherwise) {
  const Vector3d p = shape.vector(name, builder.report).value_or(otherwise);
  if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) return p;
  builder.report.fail(fmt::format("\"{}\" is not finite", name), shape.find(name)->origin);
}

// The frame around unit n in which Mitsuba counts angles: its z is n.
Transform frame_around(Vector3d n) { return transform_of(Frame(n)); }

Transform cylinder_to_object(Builder& builder, const Object& shape) {
  const Vector3d p0 = point(builder, shape, "p0", {0, 0, 0}), p1 = point(builder, shape, "p1", {0, 0, 1});
  const double radius = radius_of(builder, shape), height = length(p1 - p0);
  if (!(height > 0) || !std::isfinite(height))
    builder.report.fail("p0 and p1 of the cylinder are the same point", shape.origin);
  return translate(p0) * frame_around((p1 - p0) * (1 / height)) * scale({radius, radius, height});
}

}  // namespace

std::optional<ShapeGeometry> analytic_shape(Builder& builder, const Object& shape) {
  const std::string kind = kind_of(shape);
  const auto shared = [&](TriangleMesh (*make)()) { return shared_mesh(builder, shape, {kind, 0, 0}, make); };
  if (kind == "rectangle") return ShapeGeometry{shared(rectangle), {}, true};
  if (kind == "cube") return ShapeGeometry{shared(cube), {}, true};
  if (kind == "disk") return ShapeGeometry{shared(disk), {}, true};
  if (kind == "sphere") {
    const double r = radius_of(builder, shape);
    const Transform to_object = translate(point(builder, shape, "center", {})) * scale({r, r, r});
    return ShapeGeometry{shared(sphere), to_object, false};  // a mirror turns it inside out
  }
  if (kind == "cylinder") return ShapeGeometry{shared(cylinder), cylinder_to_object(builder, shape), true};
  return std::nullopt;
}

}  // namespace vitrail::mitsuba
