// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/clip_planes.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/bounds.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

std::array<Point3d, 8> corners_of(const Bounds3d& b) {
  std::array<Point3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {(i & 1 ? b.upper : b.lower).x, (i & 2 ? b.upper : b.lower).y,
                  (i & 4 ? b.upper : b.lower).z};
  return corners;
}

void extend_by(Bounds3d& box, const Bounds3d& of, const Transform& to) {
  if (of.empty()) return;
  for (const Point3d p : corners_of(of)) extend(box, transform_point(to, p));
}

Bounds3d box_of(const TriangleMesh& mesh) {
  const Bounds3f b = bounds_of(mesh);
  return b.empty() ? Bounds3d{} : Bounds3d{cast<double>(b.lower), cast<double>(b.upper)};
}

// Every mesh and every prototype is looked at once, however many instances there are.
struct Boxes {
  std::vector<Bounds3d> meshes, prototypes;

  explicit Boxes(const Scene& scene) {
    for (const TriangleMesh& mesh : scene.meshes) meshes.push_back(box_of(mesh));
    for (const Prototype& p : scene.prototypes) prototypes.push_back(around(p.shapes, p.instances));
  }
  Bounds3d around(const std::vector<Shape>& shapes, const std::vector<Instance>& instances) const {
    Bounds3d box;
    for (const Shape& s : shapes) extend_by(box, meshes.at(s.mesh.value), s.object_to_world);
    for (const Instance& i : instances)
      extend_by(box, prototypes.at(i.prototype.value), i.prototype_to_world);
    return box;
  }
};

// What lies on the positive side: a·p + b > 0.
struct HalfSpace {
  Vector3d a;
  double b;
  double at(Point3d p) const { return dot(a, p - Point3d{}) + b; }
};
using Region = std::vector<HalfSpace>;

// What is seen between two depths, in camera space. Pixels' filters reach over the edges of the picture.
Region seen_between(const Camera& camera, double near, double far) {
  constexpr double beyond_edges = 0.05;
  Region region;
  const auto add_sides = [&](const ScreenWindow& s, const Lens& lens, bool perspective) {
    const double spread = lens.radius > 0 ? lens.radius / lens.focal_distance : 0;
    const auto side = [&](Vector3d inwards, double edge, double width) {
      const double to = edge + beyond_edges * width;
      const double slope = (perspective ? to : 0) + spread, offset = (perspective ? 0 : to) + lens.radius;
      region.push_back({inwards + Vector3d{0, 0, slope}, offset});
    };
    side({1, 0, 0}, -s.x0, s.x1 - s.x0), side({-1, 0, 0}, s.x1, s.x1 - s.x0);
    side({0, 1, 0}, -s.y0, s.y1 - s.y0), side({0, -1, 0}, s.y1, s.y1 - s.y0);
  };
  if (const auto* c = std::get_if<PerspectiveCamera>(&camera)) add_sides(c->screen, c->lens, true);
  if (const auto* c = std::get_if<OrthographicCamera>(&camera)) add_sides(c->screen, c->lens, false);
  region.push_back({{0, 0, 1}, -near});
  if (std::isfinite(far)) region.push_back({{0, 0, -1}, far});
  return region;
}

// Whether anything of a convex polygon is inside (Sutherland & Hodgman 1974).
bool meets(std::vector<Point3d> polygon, const Region& region) {
  for (const HalfSpace& h : region) {
    std::vector<Point3d> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point3d p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double at_p = h.at(p), at_q = h.at(q);
      if (at_p > 0) inside.push_back(p);
      if ((at_p > 0) != (at_q > 0)) inside.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    if (inside.empty()) return false;
    polygon = std::move(inside);
  }
  return true;
}

struct Search {
  const Scene& scene;
  const Boxes& boxes;
  const Region& region;

  bool may_meet(const Bounds3d& box, const Transform& to_camera) const {
    if (box.empty()) return false;
    std::array<Point3d, 8> corners = corners_of(box);
    for (Point3d& p : corners) p = transform_point(to_camera, p);
    return std::ranges::none_of(region, [&](const HalfSpace& h) {
      return std::ranges::all_of(corners, [&](Point3d p) { return !(h.at(p) > 0); });
    });
  }
  bool finds(const Shape& shape, const Transform& to_camera) const {
    const TriangleMesh& known = scene.meshes[shape.mesh.value];
    const Transform to = to_camera * shape.object_to_world;
    if (!may_meet(boxes.meshes[shape.mesh.value], to)) return false;
    TriangleMesh storage;
    const TriangleMesh& mesh = loaded(known, storage);
    return std::ranges::any_of(mesh.triangles, [&](const auto& triangle) {
      std::vector<Point3d> polygon;
      for (const std::uint32_t corner : triangle)
        polygon.push_back(transform_point(to, cast<double>(mesh.positions[corner])));
      return meets(std::move(polygon), region);
    });
  }
  bool finds(const std::vector<Shape>& shapes, const std::vector<Instance>& instances,
             const Transform& to_camera) const {
    return std::ranges::any_of(shapes, [&](const Shape& s) { return finds(s, to_camera); }) ||
           std::ranges::any_of(instances, [&](const Instance& i) {
             const Transform to = to_camera * i.prototype_to_world;
             const Prototype& p = scene.prototypes[i.prototype.value];
             return may_meet(boxes.prototypes[i.prototype.value], to) && finds(p.shapes, p.instances, to);
           });
  }
};

ClipRange* clip_in(Camera& camera) {
  if (auto* c = std::get_if<PerspectiveCamera>(&camera)) return &c->clip;
  if (auto* c = std::get_if<OrthographicCamera>(&camera)) return &c->clip;
  return nullptr;
}

}  // namespace

ClipRange wide_clip(const Scene& scene, const Transform& camera_to_world) {
  Bounds3d box = Boxes(scene).around(scene.shapes, scene.instances);
  extend(box, transform_point(camera_to_world, {0, 0, 0}));
  const double reach = 2 * length(extent(box));
  if (!(reach > 0) || !std::isfinite(reach)) return {1e-2f, 1e4f};
  const double digits = std::ceil(std::log10(reach));
  return {static_cast<float>(std::pow(10, std::min(digits - 6, -2.0))),
          static_cast<float>(std::pow(10, digits))};
}

void keep_clip(Scene& scene, const ClipRange& planes) {
  ClipRange* const clip = clip_in(scene.camera);
  if (!clip) return;
  *clip = planes;
  const Transform to_camera =
      std::visit([](const auto& c) { return inverse(c.camera_to_world); }, scene.camera);
  const Boxes boxes(scene);
  const auto is_cut = [&](float near, float far) {
    const Region region = seen_between(scene.camera, static_cast<double>(near), static_cast<double>(far));
    return Search{scene, boxes, region}.finds(scene.shapes, scene.instances, to_camera);
  };
  if (clip->near > 0 && !scene.camera_medium && !is_cut(0, clip->near)) clip->near = 0;
  constexpr float infinite = ClipRange{}.far;
  if (std::isfinite(clip->far) && !is_cut(clip->far, infinite)) clip->far = infinite;
}

}  // namespace vitrail
