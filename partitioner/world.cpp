// SPDX-License-Identifier: Apache-2.0
#include "partitioner/world.h"

#include <fmt/format.h>

#include "bundle/interiors.h"
#include "partitioner/appearance.h"
#include "partitioner/requirements.h"
#include "scene/deferred_mesh.h"

namespace vitrail {

namespace {

std::vector<Placement> placements_of(const Scene& scene, std::uint64_t& triangles) {
  std::vector<Placement> placements;
  triangles = 0;
  const auto add = [&](const Shape& shape, const Transform& outer) {
    const TriangleMesh& mesh = scene.meshes.at(shape.mesh.value);
    if (triangles_of(mesh) == 0) return;
    placements.push_back(placement_of(mesh, shape, outer, triangles));
    triangles += triangles_of(mesh);
  };
  for (const Shape& shape : scene.shapes) add(shape, {});
  for (const Instance& instance : scene.instances)
    for (const Shape& shape : scene.prototypes.at(instance.prototype.value).shapes)
      add(shape, instance.prototype_to_world);
  if (triangles >= no_triangle)
    throw Error(fmt::format("the scene has {} triangles with all instances; the most is {}", triangles,
                            no_triangle - 1));
  return placements;
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

Vector3d offset_of(const std::vector<Placement>& placements) {
  Bounds3d bounds;
  for (const Placement& p : placements) extend(bounds, world_bounds(p));
  if (bounds.empty()) return {};
  const Point3f c = cast<float>(center(bounds));
  return {c.x, c.y, c.z};
}

std::int32_t new_id(const std::vector<std::int32_t>& ids, const auto& old) {
  return old ? ids.at(old->value) : -1;
}

void make_surfaces(const Appearance& appearance, const std::vector<Placement>& placements, Manifest& m) {
  for (const Placement& p : placements) {
    const Surface surface = surface_of(p, appearance);
    if (!m.surfaces.empty()) {
      Surface same = m.surfaces.back();
      same.first_triangle = surface.first_triangle;
      if (same == surface) continue;
    }
    m.surfaces.push_back(surface);
  }
}

bool have_normals(const std::vector<Placement>& placements, const Scene& scene) {
  return std::ranges::any_of(placements, [&](const Placement& p) {
    const MaterialModel& model = scene.materials.at(p.shape->material.value).model;
    return has_normals(*p.mesh) && !std::holds_alternative<InterfaceMaterial>(model);
  });
}

// Moves what stands in the world to the bundle's coordinates.
struct LightMover {
  Vector3d offset;
  void operator()(PointLight& l) const { l.position = l.position - offset; }
  void operator()(EnvironmentLight& l) const {
    if (!l.portal) return;
    for (Point3d& corner : *l.portal) corner = corner - offset;
  }
  void operator()(DistantLight&) const {}
  void operator()(InfiniteLight&) const {}
  void operator()(auto& l) const { l.light_to_world = translate(-offset) * l.light_to_world; }
};

void move_records(const Scene& scene, Appearance& appearance, Manifest& m) {
  m.materials = std::move(appearance.materials);
  m.area_lights = std::move(appearance.area_lights);
  m.media = std::move(appearance.media);
  for (Medium& medium : m.media) medium.medium_to_world = translate(-m.offset) * medium.medium_to_world;
  m.textures = std::move(appearance.textures);
  move(m.textures, -m.offset);
  m.lights = std::move(appearance.lights);
  for (Light& light : m.lights) std::visit(LightMover{m.offset}, light.model);
  m.texture_files = std::move(appearance.texture_files);
  m.attributes = static_cast<std::uint32_t>(appearance.attributes.size());
  m.camera = scene.camera;
  std::visit([&](auto& c) { c.camera_to_world = translate(-m.offset) * c.camera_to_world; }, m.camera);
  m.camera_medium = new_id(appearance.medium_ids, scene.camera_medium);
  m.film = scene.film;
  m.settings = scene.settings;
}

}  // namespace

World world_of(const Scene& scene, const std::filesystem::path& bundle, bool everything) {
  World world;
  Manifest& m = world.manifest;
  Appearance appearance = appearance_of(scene, bundle);
  world.placements = placements_of(scene, m.triangles);
  m.offset = offset_of(world.placements);
  make_surfaces(appearance, world.placements, m);
  move_records(scene, appearance, m);
  static_cast<void>(Interiors(m));  // throws where there are too many
  m.requirements =
      everything ? all_requirements() : requirements_of(m, have_normals(world.placements, scene));
  world.attributes = std::move(appearance.attributes);
  return world;
}

}  // namespace vitrail
