// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/shape_hits.h"

#include <cmath>

#include "scene/geometry/frame.h"

namespace vitrail::pov {

namespace {

// Real zeros of a t² + b t + c.
std::vector<double> zeros(double a, double b, double c) {
  if (a == 0) return b == 0 ? std::vector<double>{} : std::vector<double>{-c / b};
  const double inside = b * b - 4 * a * c;
  if (inside < 0) return {};
  const double q = -0.5 * (b + std::copysign(std::sqrt(inside), b));
  if (q == 0) return {0};
  return {q / a, c / q};
}

class ShapeHits {
 public:
  ShapeHits(const Object& object, const Line& line, std::vector<Hit>& hits)
      : object_(object), line_(line), hits_(hits) {}

  void operator()(const SphereShape& s) {
    const Vector3d d = line_.from - s.center;
    for (const double t :
         zeros(dot(line_.along, line_.along), 2 * dot(d, line_.along), dot(d, d) - s.radius * s.radius))
      add(t, line_.at(t) - s.center);
  }
  void operator()(const BoxShape& s) {
    Bounds3d box;
    extend(box, s.corner1);
    extend(box, s.corner2);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        const double side = upper ? box.upper[axis] : box.lower[axis];
        if (line_.along[axis] == 0) continue;
        const double t = (side - line_.from[axis]) / line_.along[axis];
        const Point3d p = line_.at(t);
        bool on = true;
        for (int other = 0; other < 3; ++other)
          on = on && (other == axis || (p[other] >= box.lower[other] && p[other] <= box.upper[other]));
        Vector3d normal;
        normal[axis] = upper ? 1 : -1;
        if (on) add(t, normal);
      }
  }
  void operator()(const PlaneShape& s) {
    add(at_plane(s.normal, Point3d{} + s.normal * s.distance), s.normal);
  }
  void operator()(const DiscShape& s) {
    const double t = at_plane(s.normal, s.center);
    const double from_center = length(line_.at(t) - s.center);
    if (from_center <= s.radius && from_center >= s.hole_radius) add(t, s.normal);
  }
  // Around the axis the radius is base_radius + slope · height.
  void operator()(const ConeShape& s) {
    const double high = length(s.cap - s.base), slope = (s.cap_radius - s.base_radius) / high;
    const Vector3d axis = (s.cap - s.base) * (1 / high), d = line_.from - s.base;
    const double h0 = dot(d, axis), h1 = dot(line_.along, axis);
    const Vector3d p = d - axis * h0, q = line_.along - axis * h1;
    const double r0 = s.base_radius + slope * h0, r1 = slope * h1;
    for (const double t : zeros(dot(q, q) - r1 * r1, 2 * (dot(p, q) - r0 * r1), dot(p, p) - r0 * r0)) {
      const double h = h0 + h1 * t;
      if (h >= 0 && h <= high) add(t, (p + q * t) - axis * (slope * (s.base_radius + slope * h)));
    }
    if (s.open) return;
    for (const bool upper : {false, true}) {
      const Point3d center = upper ? s.cap : s.base;
      const double t = at_plane(axis, center);
      if (length(line_.at(t) - center) <= (upper ? s.cap_radius : s.base_radius))
        add(t, upper ? axis : -axis);
    }
  }
  void operator()(const MeshShape&) { of_triangles(); }
  void operator()(const SolidShape&) { of_triangles(); }
  void operator()(const GroupShape&) {}
  void operator()(const LightShape&) {}

 private:
  void add(double t, Vector3d normal) {
    if (t > 0 && std::isfinite(t)) hits_.push_back({t, normal});
  }
  double at_plane(Vector3d normal, Point3d on) const {
    return dot(on - line_.from, normal) / dot(line_.along, normal);
  }
  void of_triangles() {
    tree_of(object_).hits(line_, [&](double t, Vector3d normal, double) { add(t, normal); });
  }

  const Object& object_;
  const Line& line_;
  std::vector<Hit>& hits_;
};

// Of a mesh's triangle, POV-Ray's front is where it runs clockwise.
std::vector<TriangleTree::Triangle> triangles_of(const MeshShape& shape) {
  std::vector<TriangleTree::Triangle> triangles;
  for (const MeshShape::Part& part : shape.parts) {
    const TriangleMesh& mesh = *part.mesh;
    for (const auto& corners : mesh.triangles) {
      TriangleTree::Triangle t;
      for (std::size_t k = 0; k < 3; ++k) t.corners[k] = cast<double>(mesh.positions[corners[k]]);
      t.normals.fill(cross(t.corners[2] - t.corners[0], t.corners[1] - t.corners[0]));
      for (std::size_t k = 0; k < 3 && !mesh.normals.empty(); ++k)
        t.normals[k] = to_vector(cast<double>(mesh.normals[corners[k]]));
      triangles.push_back(t);
    }
  }
  return triangles;
}

// Crossings on the way to infinity: of bodies that may overlap by their sides, of a mesh all that are odd.
bool is_enclosed(const Object& object, Point3d p) {
  const TriangleTree& tree = tree_of(object);
  const Line line{p, {0.5421, 0.3307, 0.7725}};  // no simple ratios: not along edges
  int leaves = 0, crossings = 0;
  tree.hits(line, [&](double, Vector3d, double side) {
    leaves += side > 0 ? 1 : -1;
    ++crossings;
  });
  return std::holds_alternative<MeshShape>(object.shape) ? crossings % 2 == 1 : leaves > 0;
}

}  // namespace

const TriangleTree& tree_of(const Object& object) {
  const Object& made = object.original ? *object.original : object;
  if (!made.tree) {
    if (const auto* mesh = std::get_if<MeshShape>(&made.shape))
      made.tree = std::make_shared<TriangleTree>(triangles_of(*mesh));
    else if (const auto* solid = std::get_if<SolidShape>(&made.shape); solid && solid->make)
      made.tree = std::make_shared<TriangleTree>(tree_of(solid->make()));
    else
      made.tree = std::make_shared<TriangleTree>(std::vector<TriangleTree::Triangle>{});
  }
  return *made.tree;
}

void hits_of_shape(const Object& object, const Line& line, std::vector<Hit>& hits) {
  std::visit(ShapeHits(object, line, hits), object.shape);
}

bool is_inside_shape(const Object& object, Point3d p) {
  if (const auto* s = std::get_if<SphereShape>(&object.shape)) return length(p - s->center) < s->radius;
  if (const auto* s = std::get_if<BoxShape>(&object.shape)) {
    Bounds3d box;
    extend(box, s->corner1);
    extend(box, s->corner2);
    for (int axis = 0; axis < 3; ++axis)
      if (!(p[axis] > box.lower[axis] && p[axis] < box.upper[axis])) return false;
    return true;
  }
  if (const auto* s = std::get_if<PlaneShape>(&object.shape))
    return dot(p - Point3d{}, s->normal) < s->distance;
  if (const auto* s = std::get_if<DiscShape>(&object.shape)) return dot(p - s->center, s->normal) < 0;
  if (const auto* s = std::get_if<ConeShape>(&object.shape)) {
    const double high = length(s->cap - s->base);
    const Vector3d axis = (s->cap - s->base) * (1 / high), d = p - s->base;
    const double h = dot(d, axis), radius = s->base_radius + (s->cap_radius - s->base_radius) * h / high;
    return h > 0 && h < high && length(d - axis * h) < radius;
  }
  if (const auto* s = std::get_if<MeshShape>(&object.shape)) return s->closed && is_enclosed(object, p);
  if (const auto* s = std::get_if<SolidShape>(&object.shape))
    return s->inside ? s->inside(p) : is_enclosed(object, p);
  return false;
}

}  // namespace vitrail::pov
