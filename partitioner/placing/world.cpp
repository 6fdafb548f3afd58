// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "bundle/interiors.h"
#include "bundle/triangle_number.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/appearance/requirements.h"
#include "partitioner/placing/decimals.h"
#include "partitioner/placing/object_bounds.h"
#include "partitioner/placing/plan_scene.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

std::int32_t new_id(const std::vector<std::int32_t>& ids, const auto& old) {
  return old ? ids.at(old->value) : -1;
}

// Of those that the scene's file gives no name: by their number, those of prototypes after the others. So
// they are the same whatever is kept of instances.
class ShapeNames {
 public:
  explicit ShapeNames(const Scene& scene) {
    if (!tells_shapes(scene.film.layers)) return;
    add(scene.shapes);
    for (const Prototype& prototype : scene.prototypes) add(prototype.shapes);
  }
  std::string of(const Shape& shape) const {
    return shape.name.empty() ? fmt::format("shape-{}", numbers_.at(&shape)) : shape.name;
  }

 private:
  void add(const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) numbers_.emplace(&shape, numbers_.size() + 1);
  }

  std::unordered_map<const Shape*, std::size_t> numbers_;
};

// One a run of placements that are alike, or where the film tells shapes apart one each. Returns how many.
std::uint32_t make_surfaces(const Appearance& appearance, const std::vector<Placement>& placements,
                            VertexDoubts& doubts, const ShapeNames& names, World& world) {
  Manifest& m = world.manifest;
  const std::size_t first = m.surfaces.size();
  for (const Placement& p : placements) {
    Surface surface = surface_of(p, appearance);
    surface.vertex_doubt = doubts.of(p);
    if (m.surfaces.size() > first && !tells_shapes(m.film.layers)) {
      Surface same = m.surfaces.back();
      same.first_triangle = surface.first_triangle;
      if (same == surface) continue;
    }
    m.surfaces.push_back(surface);
    if (tells_shapes(m.film.layers)) world.shape_names.push_back(names.of(*p.shape));
  }
  return static_cast<std::uint32_t>(m.surfaces.size() - first);
}

bool have_normals(const std::vector<Placement>& placements, const Scene& scene) {
  return std::ranges::any_of(placements, [&](const Placement& p) {
    const MaterialModel& model = scene.materials.at(p.shape->material.value).model;
    return has_normals(*p.mesh) && !std::holds_alternative<InterfaceMaterial>(model);
  });
}

std::uint64_t quadrics_in(const std::vector<ObjectUse>& uses, const std::vector<QuadricRun>& runs,
                          const std::vector<Assembly>& objects) {
  std::vector<std::uint64_t> in(objects.size());
  const auto sum_of = [&](const std::vector<ObjectUse>& of) {
    std::uint64_t sum = 0;
    for (const ObjectUse& use : of) sum += in[use.object];
    return sum;
  };
  for (std::size_t i = 0; i < objects.size(); ++i) in[i] = objects[i].quadric ? 1 : sum_of(objects[i].uses);
  std::uint64_t sum = sum_of(uses);
  for (const QuadricRun& run : runs) sum += run.places->size();
  return sum;
}

// Moves what stands in the world to the bundle's coordinates.
struct LightMover {
  Vector3d offset;
  void operator()(PointLight& l) const { l.position = l.position - offset; }
  void operator()(EnvironmentLight& l) const {
    if (!*std::as_const(l).portal) return;
    for (Point3d& corner : **l.portal) corner = corner - offset;
  }
  void operator()(DistantLight&) const {}
  void operator()(InfiniteLight&) const {}
  void operator()(auto& l) const { l.light_to_world = translate(-offset) * *l.light_to_world; }
};

void move_records(const Scene& scene, Appearance& appearance, Manifest& m) {
  m.materials = std::move(appearance.materials);
  m.area_lights = std::move(appearance.area_lights);
  m.media = std::move(appearance.media);
  for (Medium& medium : m.media) medium.medium_to_world = translate(-m.offset) * medium.medium_to_world;
  m.textures = std::move(appearance.textures);
  m.tables = std::move(appearance.tables);
  move(m.textures, -m.offset);
  m.lights = std::move(appearance.lights);
  for (Light& light : m.lights) std::visit(LightMover{m.offset}, light.model);
  m.texture_files = std::move(appearance.texture_files);
  m.attributes = static_cast<std::uint32_t>(appearance.attributes.size());
  m.camera = scene.camera;
  std::visit([&](auto& c) { c.camera_to_world = translate(-m.offset) * c.camera_to_world; }, m.camera);
  m.camera_motion = translate(-m.offset) * scene.camera_motion;
  m.camera_medium = new_id(appearance.medium_ids, scene.camera_medium);
  m.settings = scene.settings;
  // A depth is meant for what scatters at surfaces.
  if (std::ranges::any_of(appearance.material_interiors, [](std::int32_t medium) { return medium >= 0; }))
    m.settings.max_depth = unlimited_depth;
}

// Files hold the ids of triangles that are no instance's in 32 bits.
void require_numbers(const Assembly& a) {
  for (const Placement& p : a.placements)
    if (p.first_triangle + triangles_of(*p.mesh) > triangle_numbers)
      throw Error(fmt::format("more than {} triangles are no instances'", triangle_numbers));
}

}  // namespace

World world_of(const Scene& scene, const std::filesystem::path& bundle, const WorldOptions& options) {
  World world;
  Manifest& m = world.manifest;
  m.film = scene.film;
  Appearance appearance = appearance_of(scene, bundle, {.cache = options.cache});
  ScenePlan plan = plan_scene(scene);
  m.triangles = plan.scene.triangles;
  m.offset = plan.scene.centre;
  m.core = plan.core;
  world.coarse = plan.coarse;
  for (const ObjectUse& use : plan.scene.uses)
    extend(world.instance_bounds, placed_bounds(plan.objects[use.object], use.to_parent));
  bool normals = have_normals(plan.scene.placements, scene);
  for (const Assembly& object : plan.objects) normals = normals || have_normals(object.placements, scene);
  for (const QuadricRun& run : plan.scene.runs) {
    const Bounds3d& box = run.places->bounds();
    extend(world.instance_bounds,
           placed_bounds(run.to_parent, {cast<float>(box.lower), cast<float>(box.upper)}));
  }
  world.tessellated = std::move(plan.tessellated);

  const auto shines = [&](const Placement& p) {
    return is_lamp(appearance.area_lights, surface_of(p, appearance));
  };
  if (!options.keep_instances) flatten(plan);
  for (const Placement& p : expanded(plan, shines)) {
    const Surface surface = surface_of(p, appearance);
    world.shining.push_back({p, static_cast<std::uint32_t>(surface.area_light), surface.opacity});
  }
  require_numbers(plan.scene);
  for (const Assembly& object : plan.objects) require_numbers(object);
  VertexDoubts doubts(appearance);
  const ShapeNames names(scene);
  make_surfaces(appearance, plan.scene.placements, doubts, names, world);
  for (const Placement& p : plan.scene.placements) world.own_triangles += triangles_of(*p.mesh);
  world.placements = std::move(plan.scene.placements);
  world.uses = std::move(plan.scene.uses);
  world.runs = std::move(plan.scene.runs);
  world.quadrics = quadrics_in(world.uses, world.runs, plan.objects);
  for (Assembly& object : plan.objects) {
    const auto first = static_cast<std::uint32_t>(m.surfaces.size());
    const std::uint32_t count = make_surfaces(
        appearance, object.quadric ? std::vector{*object.quadric} : object.placements, doubts, names, world);
    world.objects.push_back({std::move(object), first, count});
  }
  move_records(scene, appearance, m);
  static_cast<void>(Interiors(m));  // throws where there are too many
  m.requirements = options.everything ? all_requirements() : requirements_of(m, normals);
  m.requirements.motion =
      m.camera_motion.moves() ||
      std::ranges::any_of(world.objects, [](const WorldObject& o) { return o.assembly.motion != nullptr; });
  if (m.requirements.motion) m.shutter = scene.shutter;
  world.attributes = std::move(appearance.attributes);
  world.material_ids = std::move(appearance.material_ids);
  return world;
}

}  // namespace vitrail
