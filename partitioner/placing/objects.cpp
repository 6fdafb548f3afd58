// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "partitioner/placing/frame.h"
#include "scene/deferred_mesh.h"

namespace vitrail {

namespace {

// About what a domain file takes for a triangle and for an instance, and a file for itself.
constexpr double triangle_bytes = 62, instance_bytes = 192, file_bytes = 1024;
constexpr double most_condition = 1e4;

double row_sum(const std::array<double, 4>& row) {
  return std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]);
}

double greatest(Vector3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

Bounds3d around(Point3d p, double reach) {
  const Vector3d r{reach, reach, reach};
  return {p - r, p + r};
}

Bounds3d common(const Bounds3d& a, const Bounds3d& b) {
  Bounds3d out;
  for (int axis = 0; axis < 3; ++axis) {
    out.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
    out.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
  }
  return out;
}

double greatest_row(const Transform& t) {
  return std::max({row_sum(t.m[0]), row_sum(t.m[1]), row_sum(t.m[2])});
}

// Whether rays can be taken to the object's space without much loss.
bool can_be_kept(const Transform& t) {
  return is_affine(t) && is_invertible(t) && greatest_row(t) * greatest_row(inverse(t)) <= most_condition;
}

Bounds3d transformed(const Transform& t, const Bounds3d& box) {
  Bounds3d out;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner)
    extend(out,
           transform_point(t, {(corner & 1 ? box.upper : box.lower).x, (corner & 2 ? box.upper : box.lower).y,
                               (corner & 4 ? box.upper : box.lower).z}));
  return out;
}

// Throws Error for a box that floats cannot hold: with the vertex, where there is one.
Bounds3d checked(const Bounds3d& box, const Placement& p) {
  if (box.empty() || (is_finite(cast<float>(box.lower)) && is_finite(cast<float>(box.upper)))) return box;
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(*p.mesh, storage);
  const PlacementRule rule;
  const ReflectanceFitter fitter;
  PlacedTriangles placed = make_room(rule, mesh.triangles.size());
  MeshPlacer(p, mesh, rule, fitter).place(0, mesh.triangles.size(), placed, 0);
  throw Error("a shape reaches beyond 3.4e38 in the world", {});
}

// The box of the corners of the mesh's own.
Bounds3d world_bounds(const Placement& p) {
  const Bounds3f own = bounds_of(*p.mesh);
  Bounds3d box;
  for (int corner = 0; corner < 8 && !own.empty(); ++corner) {
    const auto at = [&](int axis) { return double{(corner >> axis & 1 ? own.upper : own.lower)[axis]}; };
    extend(box, transform_point(p.to_world, {at(0), at(1), at(2)}));
  }
  return checked(box, p);
}

// The mesh's half, where it stands.
FramePart part_of_mesh(const Placement& p) {
  const MeshFocus focus = focus_of(*p.mesh);
  return {transform_point(p.to_world, focus.centre), greatest_row(p.to_world) * focus.radius,
          static_cast<double>(triangles_of(*p.mesh))};
}

class Planner {
 public:
  explicit Planner(const Scene& scene)
      : scene_(scene), uses_(scene.prototypes.size()), object_of_(scene.prototypes.size(), -1) {
    count(scene.instances, scene.prototypes.size());
    for (std::size_t i = 0; i < scene.prototypes.size(); ++i) count(scene.prototypes[i].instances, i);
  }

  ScenePlan plan() {
    for (std::size_t i = 0; i < scene_.prototypes.size(); ++i) {
      const Prototype& prototype = scene_.prototypes[i];
      if (uses_[i] < 2) continue;
      Assembly object;
      add(object, prototype.shapes, prototype.instances, {});
      const double bytes = triangle_bytes * own_triangles(object) +
                           instance_bytes * static_cast<double>(object.uses.size()) + file_bytes;
      const double copies = triangle_bytes * static_cast<double>(object.triangles);
      const auto uses = static_cast<double>(uses_[i]);
      if (object.triangles == 0 || bytes + instance_bytes * uses >= copies * uses) continue;
      finish(object, false);
      object_of_[i] = static_cast<int>(plan_.objects.size());
      plan_.objects.push_back(std::move(object));
    }
    add(plan_.scene, scene_.shapes, scene_.instances, {});
    if (plan_.scene.triangles >= no_triangle)
      throw Error(fmt::format("the scene has {} triangles with all instances; the most is {}",
                              plan_.scene.triangles, no_triangle - 1));
    finish(plan_.scene, true);
    return std::move(plan_);
  }

 private:
  void count(const std::vector<Instance>& instances, std::size_t below) {
    for (const Instance& instance : instances) {
      if (instance.prototype.value >= below)
        throw Error("a prototype holds itself", location(scene_, instance.origin));
      ++uses_[instance.prototype.value];
    }
  }

  static double own_triangles(const Assembly& a) {
    double sum = 0;
    for (const Placement& p : a.placements) sum += static_cast<double>(triangles_of(*p.mesh));
    return sum;
  }

  void add(Assembly& a, const std::vector<Shape>& shapes, const std::vector<Instance>& instances,
           const Transform& outer) {
    for (const Shape& shape : shapes) {
      const TriangleMesh& mesh = scene_.meshes.at(shape.mesh.value);
      if (triangles_of(mesh) == 0) continue;
      a.placements.push_back(placement_of(mesh, shape, outer, a.triangles));
      a.triangles += triangles_of(mesh);
    }
    for (const Instance& instance : instances) {
      const Prototype& prototype = scene_.prototypes[instance.prototype.value];
      const Transform t = outer * instance.prototype_to_world;
      const int object = object_of_[instance.prototype.value];
      const bool fits = object >= 0 && plan_.objects[static_cast<std::size_t>(object)].depth <
                                           max_instance_depth - (&a == &plan_.scene ? 0 : 1);
      if (!fits || !can_be_kept(t)) {
        add(a, prototype.shapes, prototype.instances, t);
        continue;
      }
      const Assembly& part = plan_.objects[static_cast<std::size_t>(object)];
      // Finished when the centre is known.
      a.uses.push_back({static_cast<std::uint32_t>(object), affine(t * translate(part.centre)), a.triangles});
      a.triangles += part.triangles;
      a.depth = std::max(a.depth, part.depth + 1);
    }
  }

  void finish(Assembly& a, bool is_scene) {
    Bounds3d box, own;
    for (const Placement& p : a.placements) extend(own, world_bounds(p));
    if (!own.empty()) extend(box, own);
    for (const ObjectUse& use : a.uses) extend(box, box_of(use));
    if (box.empty()) return;
    const std::vector<FramePart> parts = parts_of(a);
    const FramePart whole = whole_of(parts);
    const Point3d origin =
        is_scene ? origin_of(parts, box, viewpoint_of(scene_.camera)) : origin_of(parts, box, {});
    a.centre = (is_scene ? cast<double>(cast<float>(origin)) : origin) - Point3d{};
    a.radius = whole.radius;
    if (is_scene) find_core(box, whole);
    for (ObjectUse& use : a.uses)
      for (int axis = 0; axis < 3; ++axis) use.to_parent.m[axis][3] -= a.centre[axis];
    if (!own.empty()) a.bounds = {cast<float>(own.lower - a.centre), cast<float>(own.upper - a.centre)};
    for (const ObjectUse& use : a.uses)
      extend(a.bounds, placed_bounds(use.to_parent, plan_.objects[use.object].bounds));
  }

  // Before the centre is taken off. The core is what of the parts is within `near_radii` of the half of them
  // all.
  void find_core(const Bounds3d& box, const FramePart& whole) {
    constexpr double rounding = 0x1p-24, coarse = 1e-3;
    const Assembly& a = plan_.scene;
    const double reach = near_radii * whole.radius;
    const Bounds3d limit = around(whole.centre, reach);
    const bool is_compact = !(reach > 0) || common(limit, box) == box;
    Bounds3d core;
    const auto add = [&](const FramePart& part, auto&& box_of_part) {
      plan_.coarse += rounding * greatest(part.centre - Point3d{} - a.centre) > coarse * part.radius;
      if (!is_compact && greatest(part.centre - whole.centre) <= reach)
        extend(core, common(limit, box_of_part()));
    };
    for (const Placement& p : a.placements)
      add(part_of_mesh(p), [&] { return transformed(p.to_world, focus_of(*p.mesh).box); });
    for (const ObjectUse& use : a.uses) add(part_of(use), [&] { return box_of(use); });
    if (!core.empty())
      plan_.core = Bounds3f{cast<float>(core.lower - a.centre), cast<float>(core.upper - a.centre)};
  }

  // Before the centre is taken off. Of very many, as many as are enough.
  std::vector<FramePart> parts_of(const Assembly& a) const {
    constexpr std::size_t enough = std::size_t{1} << 16;
    const std::size_t count = a.placements.size() + a.uses.size(), step = (count + enough - 1) / enough;
    std::vector<FramePart> parts;
    for (std::size_t i = 0; i < count; i += step)
      parts.push_back(i < a.placements.size() ? part_of_mesh(a.placements[i])
                                              : part_of(a.uses[i - a.placements.size()]));
    return parts;
  }

  FramePart part_of(const ObjectUse& use) const {
    const auto& m = use.to_parent.m;
    const Assembly& object = plan_.objects[use.object];
    const auto row = [&](std::size_t i) { return std::abs(m[i][0]) + std::abs(m[i][1]) + std::abs(m[i][2]); };
    return {{m[0][3], m[1][3], m[2][3]},
            std::max({row(0), row(1), row(2)}) * object.radius,
            static_cast<double>(object.triangles)};
  }

  // Before the parent's centre is taken off.
  Bounds3d box_of(const ObjectUse& use) const {
    const Bounds3f& b = plan_.objects[use.object].bounds;
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) std::copy_n(use.to_parent.m[i], 4, t.m[i].begin());
    const Bounds3d box = transformed(t, {cast<double>(b.lower), cast<double>(b.upper)});
    if (!is_finite(cast<float>(box.lower)) || !is_finite(cast<float>(box.upper)))
      throw Error(
          "an instance has vertices that are not finite in the world; every coordinate has to be "
          "finite and below 3.4e38");
    return box;
  }

  const Scene& scene_;
  std::vector<std::uint64_t> uses_;  // of each prototype, by instances
  std::vector<int> object_of_;       // −1: copied wherever it is used
  ScenePlan plan_;
};

}  // namespace

ScenePlan plan_scene(const Scene& scene) { return Planner(scene).plan(); }

std::vector<Placement> expanded(const ScenePlan& plan, const std::function<bool(const Placement&)>& select) {
  std::vector<Placement> out;
  const std::function<void(const ObjectUse&, const Affine&, std::uint64_t)> expand =
      [&](const ObjectUse& use, const Affine& chain, std::uint64_t first) {
        const Assembly& object = plan.objects[use.object];
        for (Placement p : object.placements) {
          if (!select(p)) continue;
          p.first_triangle += first;
          p.standing = Standing{object.centre, chain};
          out.push_back(p);
        }
        for (const ObjectUse& inner : object.uses)
          expand(inner, compose(chain, inner.to_parent), first + inner.first_triangle);
      };
  for (const ObjectUse& use : plan.scene.uses) expand(use, use.to_parent, use.first_triangle);
  std::ranges::sort(out, {}, &Placement::first_triangle);
  return out;
}

}  // namespace vitrail
