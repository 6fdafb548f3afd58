// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/plan_scene.h"

#include <algorithm>
#include <map>
#include <utility>

#include "bundle/triangle_number.h"
#include "partitioner/placing/frame.h"
#include "partitioner/placing/object_bounds.h"
#include "partitioner/placing/prototype_uses.h"
#include "partitioner/placing/shared_shapes.h"
#include "scene/records/curve_uses.h"
#include "scene/shapes/curve.h"
#include "scene/shapes/tessellate.h"

namespace vitrail {

namespace {

// About what a domain file takes for a triangle and for an instance, and a file for itself.
constexpr double triangle_bytes = 62, instance_bytes = 192, file_bytes = 1024;
constexpr double most_condition = 1e4;
// Of a quadric, which is met in double: a thread of 10⁻⁶ of its length is a cylinder.
constexpr double most_condition_of_quadrics = 1e7;

// Whether rays can be taken to the object's space without much loss.
bool can_be_kept(const Transform& t, double condition = most_condition) {
  return is_affine(t) && is_invertible(t) && greatest_row(t) * greatest_row(inverse(t)) <= condition;
}

Bounds3d around(Point3d p, double reach) {
  const Vector3d r{reach, reach, reach};
  return {p - r, p + r};
}

class Planner {
 public:
  explicit Planner(const Scene& scene)
      : scene_(scene),
        uses_(scene),
        shared_(scene),
        with_curves_(prototypes_with_curves(scene)),
        object_of_(scene.prototypes.size(), -1) {}

  ScenePlan plan() {
    const std::vector<bool> moves = moving_prototypes();
    for (std::size_t i = 0; i < scene_.prototypes.size(); ++i) {
      if (uses_.triangles(i) == 0 || (uses_.uses(i) < 2 && !moves[i])) continue;
      Assembly object;
      for (const Shape& shape : scene_.prototypes[i].shapes) add(object, shape, {});
      add(object, i, scene_.prototypes[i].instances);
      const double bytes = triangle_bytes * own_triangles(object) +
                           instance_bytes * static_cast<double>(object.uses.size()) + file_bytes;
      const double copies = triangle_bytes * static_cast<double>(object.triangles);
      const auto uses = static_cast<double>(uses_.uses(i));
      if (!moves[i] && bytes + instance_bytes * uses >= copies * uses) continue;
      object_of_[i] = static_cast<int>(add(std::move(object)));
    }
    plan_scene();
    if (plan_.scene.depth > max_instance_depth) throw Error("what moves is nested too deep within objects");
    return std::move(plan_);
  }

 private:
  std::vector<bool> moving_prototypes() const {
    std::vector<bool> moves(scene_.prototypes.size());
    const auto note = [&](const std::vector<Instance>& instances) {
      for (const Instance& instance : instances)
        if (instance.motion) moves[instance.prototype.value] = true;
    };
    note(scene_.instances);
    for (const Prototype& prototype : scene_.prototypes) note(prototype.instances);
    return moves;
  }

  // Of a prototype that is an object.
  std::uint32_t moving_object(Id<Prototype> prototype, Id<Motion> motion) {
    const auto [known, is_new] = moving_.try_emplace({prototype.value, motion.value});
    if (is_new) {
      Assembly object;
      object.motion = &scene_.motions[motion.value];
      use(object, static_cast<std::uint32_t>(object_of_[prototype.value]), Transform{});
      object.bounds = swept(*object.motion, box_of(plan_.objects, object.uses[0]));
      known->second = static_cast<std::uint32_t>(plan_.objects.size());
      plan_.objects.push_back(std::move(object));
    }
    return known->second;
  }

  void plan_scene() {
    std::vector<std::uint32_t> object_of_group;
    for (const Shape* shape : shared_.groups()) {
      const TriangleMesh& mesh = scene_.meshes[shape->mesh.value];
      Assembly object;
      object.placements.push_back({&mesh, shape, {}, SharedShapes::flip_in_object(*shape), 0});
      object.triangles = triangles_of(mesh);
      object_of_group.push_back(add(std::move(object)));
    }
    const auto shared = [&](std::size_t i) {
      const auto group = shared_.group_of(i);
      return group && can_be_kept(scene_.shapes[i].object_to_world) ? group : std::nullopt;
    };
    // Triangles of its own come first.
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i)
      if (!shared(i)) add(plan_.scene, scene_.shapes[i], {});
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i)
      if (const auto group = shared(i))
        use(plan_.scene, object_of_group[*group], scene_.shapes[i].object_to_world);
    add(plan_.scene, scene_.prototypes.size(), scene_.instances);
    finish(plan_.scene, true);
  }

  static double own_triangles(const Assembly& a) {
    double sum = 0;
    for (const Placement& p : a.placements) sum += static_cast<double>(triangles_of(*p.mesh));
    return sum;
  }

  // Returns its index.
  std::uint32_t add(Assembly object) {
    finish(object, false);
    plan_.objects.push_back(std::move(object));
    return static_cast<std::uint32_t>(plan_.objects.size() - 1);
  }

  void add(Assembly& a, const Shape& shape, const Transform& outer) {
    const TriangleMesh* stored = &scene_.meshes.at(shape.mesh.value);
    if (triangles_of(*stored) == 0) return;
    if (stored->places) {
      const Transform to_a = outer * shape.object_to_world;
      if (!is_curve(*stored->quadric) || (!shape.area_light && is_affine(to_a) && is_similarity(to_a)))
        return add_run(a, shape, *stored->places, to_a);
      stored = &tessellated(shape.mesh);
    } else if (stored->quadric) {
      if (!shines_along_its_normals(shape) &&
          can_be_kept(outer * shape.object_to_world, most_condition_of_quadrics))
        return use(a, object_of_quadric(shape), outer * shape.object_to_world);
      stored = &tessellated(shape.mesh);
    }
    const TriangleMesh& mesh = *stored;
    a.placements.push_back(placement_of(mesh, shape, outer, a.triangles));
    a.placements.back().tube = is_of_curves(scene_, shape);
    a.triangles += triangles_of(mesh);
  }

  // Lights are uses by themselves: sampling has them all.
  void add_run(Assembly& a, const Shape& shape, const QuadricPlaces& places, const Transform& t) {
    const Quadric& quadric = *scene_.meshes[shape.mesh.value].quadric;
    const QuadricRun run{&quadric, object_of_quadric(shape), &places, affine(t), a.triangles};
    if (&a == &plan_.scene && !shape.area_light) {
      a.runs.push_back(run);
      a.triangles += places.size();
      a.depth = std::max(a.depth, 1);
    } else {
      for_each_use(run, [&](const ObjectUse& u) { use(a, u.object, u.to_parent); });
    }
  }

  // All but where it stands is the shape's. Where the film tells shapes apart each has an object of its own.
  std::uint32_t object_of_quadric(const Shape& shape) {
    const auto [known, is_new] = quadrics_.try_emplace(key_of(shape));
    if (is_new || tells_shapes(scene_.film.layers)) {
      const TriangleMesh& mesh = scene_.meshes[shape.mesh.value];
      const Bounds3f box = bounds_of(mesh);
      Assembly object;
      object.quadric = Placement{&mesh, &shape, {}, SharedShapes::flip_in_object(shape), 0};
      object.triangles = 1;
      object.radius = focus_of(mesh).radius;
      object.bounds = box;
      known->second = static_cast<std::uint32_t>(plan_.objects.size());
      plan_.objects.push_back(std::move(object));
    }
    return known->second;
  }

  // Lights sample such surfaces by their triangles alone.
  bool shines_along_its_normals(const Shape& shape) const {
    return shape.area_light && scene_.area_lights[shape.area_light->value].directional;
  }

  const TriangleMesh& tessellated(Id<TriangleMesh> quadric) {
    const auto [known, is_new] = tessellated_.try_emplace(quadric.value);
    if (is_new) {
      auto mesh = std::make_unique<TriangleMesh>();
      loaded(scene_.meshes[quadric.value], *mesh);
      known->second = mesh.get();
      plan_.tessellated.push_back(std::move(mesh));
    }
    return *known->second;
  }

  void use(Assembly& a, std::uint32_t object, const Transform& t) const {
    use(a, object, affine(t * translate(plan_.objects[object].centre)));
  }

  // Finished when the centre of `a` is known.
  void use(Assembly& a, std::uint32_t object, const Affine& to_a) const {
    const Assembly& part = plan_.objects[object];
    a.uses.push_back({object, to_a, a.triangles});
    a.triangles += part.triangles;
    a.depth = std::max(a.depth, part.depth + 1);
  }

  // The instances of a prototype, or of the scene, and those within what is copied of them.
  void add(Assembly& a, std::size_t outer, const std::vector<Instance>& instances) {
    struct Open {
      const Instance* instance;
      Transform to_a;  // from the space that it stands in
    };
    std::vector<Open> open;
    const auto put = [&](const std::vector<Instance>& more, const Transform& to_a) {
      for (std::size_t i = more.size(); i-- > 0;) open.push_back({&more[i], to_a});
    };
    put(instances, {});
    while (!open.empty()) {
      const auto [instance, to_a] = open.back();
      open.pop_back();
      const std::uint32_t inner = instance->prototype.value;
      if (uses_.triangles(inner) == 0) continue;
      if (instance->motion) {
        use(a, moving_object(instance->prototype, *instance->motion), to_a);
        continue;
      }
      const Transform t = to_a * instance->prototype_to_world;
      if (object_of_[inner] >= 0 && uses_.may_keep(outer, inner) && can_be_kept(t) &&
          (!with_curves_[inner] || is_similarity(t))) {
        use(a, static_cast<std::uint32_t>(object_of_[inner]), t);
        continue;
      }
      const Prototype& prototype = scene_.prototypes[inner];
      for (const Shape& shape : prototype.shapes) add(a, shape, t);
      put(prototype.instances, t);
    }
  }

  // Of so many that a ray cannot have their ids (bundle/triangle_number.h) its own come first.
  void number_own_first(Assembly& a) const {
    if (a.triangles <= triangle_numbers) return;
    std::uint64_t next = 0;
    for (Placement& p : a.placements) p.first_triangle = std::exchange(next, next + triangles_of(*p.mesh));
    for (ObjectUse& use : a.uses)
      use.first_triangle = std::exchange(next, next + plan_.objects[use.object].triangles);
    for (QuadricRun& run : a.runs) run.first_triangle = std::exchange(next, next + run.places->size());
  }

  void finish(Assembly& a, bool is_scene) {
    number_own_first(a);
    Bounds3d box, own;
    for (const Placement& p : a.placements) extend(own, world_bounds(p));
    if (!own.empty()) extend(box, own);
    for (const ObjectUse& use : a.uses) extend(box, box_of(plan_.objects, use));
    for (const QuadricRun& run : a.runs) extend(box, box_of(run));
    if (box.empty()) return;
    const std::vector<FramePart> parts = parts_of(a);
    const FramePart whole = whole_of(parts);
    const Point3d origin =
        is_scene ? origin_of(parts, box, viewpoint_of(scene_.camera)) : origin_of(parts, box, {});
    a.centre = (is_scene ? cast<double>(cast<float>(origin)) : origin) - Point3d{};
    a.radius = whole.radius;
    if (is_scene) find_core(box, whole);
    const auto centred = [&](Affine& to_parent) {
      for (int axis = 0; axis < 3; ++axis) to_parent.m[axis][3] -= a.centre[axis];
    };
    for (ObjectUse& use : a.uses) centred(use.to_parent);
    for (QuadricRun& run : a.runs) centred(run.to_parent);
    if (!own.empty()) a.bounds = {cast<float>(own.lower - a.centre), cast<float>(own.upper - a.centre)};
    for (const ObjectUse& use : a.uses)
      extend(a.bounds, placed_bounds(plan_.objects[use.object], use.to_parent));
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
    const auto add = [&](const FramePart& part, bool is_rounded, auto&& box_of_part) {
      plan_.coarse +=
          is_rounded && rounding * greatest(part.centre - Point3d{} - a.centre) > coarse * part.radius;
      if (!is_compact && greatest(part.centre - whole.centre) <= reach)
        extend(core, common(limit, box_of_part()));
    };
    for (const Placement& p : a.placements)
      add(part_of(p), true, [&] { return transformed(p.to_world, focus_of(*p.mesh).box); });
    for (const QuadricRun& run : a.runs) add(part_of(run), false, [&] { return box_of(run); });
    for (const ObjectUse& use : a.uses)
      add(part_of(plan_.objects, use), !plan_.objects[use.object].quadric,
          [&] { return box_of(plan_.objects, use); });
    if (!core.empty())
      plan_.core = Bounds3f{cast<float>(core.lower - a.centre), cast<float>(core.upper - a.centre)};
  }

  // Before the centre is taken off. Of very many, as many as are enough.
  std::vector<FramePart> parts_of(const Assembly& a) const {
    constexpr std::size_t enough = std::size_t{1} << 16;
    const std::size_t count = a.placements.size() + a.uses.size(), step = (count + enough - 1) / enough;
    std::vector<FramePart> parts;
    for (std::size_t i = 0; i < count; i += step)
      parts.push_back(i < a.placements.size() ? part_of(a.placements[i])
                                              : part_of(plan_.objects, a.uses[i - a.placements.size()]));
    for (const QuadricRun& run : a.runs) parts.push_back(part_of(run));
    return parts;
  }

  const Scene& scene_;
  PrototypeUses uses_;
  SharedShapes shared_;
  std::vector<bool> with_curves_;               // by prototype
  std::vector<int> object_of_;                  // of each prototype; −1: copied wherever it is used
  std::map<ShapeKey, std::uint32_t> quadrics_;  // objects
  std::map<std::uint32_t, const TriangleMesh*> tessellated_;  // by mesh
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
      moving_;  // objects, by prototype and motion
  ScenePlan plan_;
};

}  // namespace

ScenePlan plan_scene(const Scene& scene) { return Planner(scene).plan(); }

}  // namespace vitrail
