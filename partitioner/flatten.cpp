// SPDX-License-Identifier: Apache-2.0
#include "partitioner/flatten.h"

#include <fmt/format.h>

#include <cmath>

#include "bundle/checksum.h"
#include "bundle/interiors.h"
#include "bundle/records.h"
#include "partitioner/appearance.h"
#include "partitioner/requirements.h"

namespace vitrail {

namespace {

std::vector<Placement> placements_of(const Scene& scene, std::uint64_t& triangles) {
  std::vector<Placement> placements;
  triangles = 0;
  const auto add = [&](const Shape& shape, const Transform& outer) {
    const TriangleMesh& mesh = scene.meshes.at(shape.mesh.value);
    if (mesh.triangles.empty()) return;
    placements.push_back(placement_of(mesh, shape, outer, triangles));
    triangles += mesh.triangles.size();
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

// Triangles without area emit nothing and are left out.
void make_emissive_triangles(FlatScene& flat) {
  Manifest& m = flat.manifest;
  for (std::size_t s = 0; s < m.surfaces.size(); ++s) {
    if (m.surfaces[s].area_light < 0) continue;
    const std::uint64_t end =
        s + 1 < m.surfaces.size() ? m.surfaces[s + 1].first_triangle : flat.triangles.size();
    for (std::uint64_t id = m.surfaces[s].first_triangle; id < end; ++id) {
      const Triangle& t = flat.triangles[id];
      const Vector3d normal =
          cross(cast<double>(t[1]) - cast<double>(t[0]), cast<double>(t[2]) - cast<double>(t[0]));
      if (!(length(normal) > 0)) continue;
      EmissiveTriangle& e = m.emissive_triangles.emplace_back();
      std::copy(t.begin(), t.end(), e.p);
      if (!flat.uvs.empty()) std::copy(flat.uvs[id].begin(), flat.uvs[id].end(), e.uv);
      e.triangle = static_cast<std::uint32_t>(id);
      e.area_light = static_cast<std::uint32_t>(m.surfaces[s].area_light);
    }
  }
}

bool has_normals(const std::vector<Placement>& placements, const Scene& scene) {
  return std::ranges::any_of(placements, [&](const Placement& p) {
    const MaterialModel& model = scene.materials.at(p.shape->material.value).model;
    return !p.mesh->normals.empty() && !std::holds_alternative<InterfaceMaterial>(model);
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

std::uint64_t scene_hash(const FlatScene& flat) {
  const std::uint64_t records = hash_of_records(flat.manifest);
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(flat.triangles)));
  hasher.add(std::as_bytes(std::span(flat.normals)));
  hasher.add(std::as_bytes(std::span(flat.uvs)));
  for (const auto& slot : flat.attributes) hasher.add(std::as_bytes(std::span(slot)));
  hasher.add(std::as_bytes(std::span(&records, 1)));
  return hasher.digest();
}

}  // namespace

FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle, bool everything) {
  FlatScene flat;
  Manifest& m = flat.manifest;
  Appearance appearance = appearance_of(scene, bundle);
  const std::vector<Placement> placements = placements_of(scene, m.triangles);
  m.offset = offset_of(placements);
  make_surfaces(appearance, placements, m);
  move_records(scene, appearance, m);
  static_cast<void>(Interiors(m));  // throws where there are too many
  m.requirements = everything ? all_requirements() : requirements_of(m, has_normals(placements, scene));

  const PlacementRule rule{m.offset, m.requirements.shading_normals, m.requirements.uv,
                           appearance.attributes};
  static_cast<PlacedTriangles&>(flat) = make_room(rule, m.triangles);
  const ReflectanceFitter fitter;
  for (const Placement& p : placements) place(p, rule, fitter, flat, p.first_triangle);
  for (const Triangle& t : flat.triangles)
    for (const Point3f& v : t) extend(m.bounds, v);
  for (int axis = 0; axis < 3 && m.triangles > 0; ++axis)
    m.scale = std::max({m.scale, std::abs(m.bounds.lower[axis]), std::abs(m.bounds.upper[axis])});
  make_emissive_triangles(flat);
  m.scene_hash = scene_hash(flat);
  return flat;
}

}  // namespace vitrail
