// SPDX-License-Identifier: Apache-2.0
#include "partitioner/flatten.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bundle/checksum.h"
#include "bundle/interiors.h"
#include "bundle/records.h"
#include "partitioner/appearance.h"
#include "partitioner/requirements.h"

namespace vitrail {

namespace {

std::int32_t new_id(const std::vector<std::int32_t>& ids, const auto& old) {
  return old ? ids.at(old->value) : -1;
}

// Returns how many.
std::uint32_t make_surfaces(const Appearance& appearance, const std::vector<Placement>& placements,
                            Manifest& m) {
  const std::size_t first = m.surfaces.size();
  for (const Placement& p : placements) {
    const Surface surface = surface_of(p, appearance);
    if (m.surfaces.size() > first) {
      Surface same = m.surfaces.back();
      same.first_triangle = surface.first_triangle;
      if (same == surface) continue;
    }
    m.surfaces.push_back(surface);
  }
  return static_cast<std::uint32_t>(m.surfaces.size() - first);
}

// Triangles without area emit nothing and are left out. `at`: where the placement's are.
void add_emissive(const Placement& p, std::int32_t area_light, const PlacedTriangles& placed,
                  std::uint64_t at, std::vector<EmissiveTriangle>& out) {
  for (std::uint64_t i = 0; i < p.mesh->triangles.size(); ++i) {
    const Triangle& t = placed.triangles[at + i];
    const Vector3d normal =
        cross(cast<double>(t[1]) - cast<double>(t[0]), cast<double>(t[2]) - cast<double>(t[0]));
    if (!(length(normal) > 0)) continue;
    EmissiveTriangle& e = out.emplace_back();
    std::copy(t.begin(), t.end(), e.p);
    if (!placed.uvs.empty()) std::copy(placed.uvs[at + i].begin(), placed.uvs[at + i].end(), e.uv);
    e.triangle = static_cast<std::uint32_t>(p.first_triangle + i);
    e.area_light = static_cast<std::uint32_t>(area_light);
  }
}

// Of everything that shines, in the order of ids: the instances' triangles too.
void make_emissive_triangles(const ScenePlan& plan, const Appearance& appearance, const PlacementRule& rule,
                             const ReflectanceFitter& fitter, Manifest& m) {
  const auto shines = [&](const Placement& p) { return surface_of(p, appearance).area_light >= 0; };
  std::vector<Placement> placements = expanded(plan, shines);
  std::ranges::copy_if(plan.scene.placements, std::back_inserter(placements), shines);
  for (const Placement& p : placements) {
    PlacedTriangles placed = make_room(rule, p.mesh->triangles.size());
    place(p, rule, fitter, placed, 0);
    add_emissive(p, surface_of(p, appearance).area_light, placed, 0, m.emissive_triangles);
  }
  std::ranges::sort(m.emissive_triangles, {}, &EmissiveTriangle::triangle);
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

void add(Hasher& hasher, const PlacedTriangles& placed) {
  hasher.add(std::as_bytes(std::span(placed.triangles)));
  hasher.add(std::as_bytes(std::span(placed.normals)));
  hasher.add(std::as_bytes(std::span(placed.uvs)));
  for (const auto& slot : placed.attributes) hasher.add(std::as_bytes(std::span(slot)));
}

std::uint64_t scene_hash(const FlatScene& flat) {
  const std::uint64_t records = hash_of_records(flat.manifest);
  Hasher hasher;
  add(hasher, flat);
  for (const FlatObject& object : flat.objects) add(hasher, object);
  for (const Assembly& a : flat.plan.objects) hasher.add(std::as_bytes(std::span(a.uses)));
  hasher.add(std::as_bytes(std::span(flat.plan.scene.uses)));
  hasher.add(std::as_bytes(std::span(&records, 1)));
  return hasher.digest();
}

// All of an assembly's own triangles.
void place_all(const std::vector<Placement>& placements, const PlacementRule& rule,
               const ReflectanceFitter& fitter, NumberedTriangles& out) {
  std::uint64_t triangles = 0;
  for (const Placement& p : placements) triangles += p.mesh->triangles.size();
  static_cast<PlacedTriangles&>(out) = make_room(rule, triangles);
  out.ids.reserve(triangles);
  for (const Placement& p : placements) {
    place(p, rule, fitter, out, out.ids.size());
    for (std::uint64_t i = 0; i < p.mesh->triangles.size(); ++i)
      out.ids.push_back(static_cast<std::uint32_t>(p.first_triangle + i));
  }
}

// Copies instead of instances.
void expand_all(ScenePlan& plan) {
  std::vector<Placement> all = expanded(plan, [](const Placement&) { return true; });
  all.insert(all.end(), plan.scene.placements.begin(), plan.scene.placements.end());
  std::ranges::sort(all, {}, &Placement::first_triangle);
  plan.scene.placements = std::move(all);
  plan.scene.uses.clear();
  plan.objects.clear();
}

}  // namespace

FlatScene flatten(const Scene& scene, const std::filesystem::path& bundle, const FlattenOptions& options) {
  FlatScene flat;
  Manifest& m = flat.manifest;
  Appearance appearance = appearance_of(scene, bundle);
  ScenePlan& plan = flat.plan = plan_scene(scene);
  m.triangles = plan.scene.triangles;
  m.offset = plan.scene.centre;
  m.bounds = plan.scene.bounds;
  for (int axis = 0; axis < 3 && m.triangles > 0; ++axis)
    m.scale = std::max({m.scale, std::abs(m.bounds.lower[axis]), std::abs(m.bounds.upper[axis])});
  bool normals = has_normals(plan.scene.placements, scene);
  for (const Assembly& object : plan.objects) normals = normals || has_normals(object.placements, scene);
  if (!options.keep_instances) expand_all(plan);

  make_surfaces(appearance, plan.scene.placements, m);
  for (const Assembly& object : plan.objects) {
    FlatObject& o = flat.objects.emplace_back();
    o.first_surface = static_cast<std::uint32_t>(m.surfaces.size());
    o.surface_count = make_surfaces(appearance, object.placements, m);
  }
  move_records(scene, appearance, m);
  static_cast<void>(Interiors(m));  // throws where there are too many
  m.requirements = options.everything ? all_requirements() : requirements_of(m, normals);

  PlacementRule rule{m.offset, m.requirements.shading_normals, m.requirements.uv, appearance.attributes};
  const ReflectanceFitter fitter;
  place_all(plan.scene.placements, rule, fitter, flat);
  make_emissive_triangles(plan, appearance, rule, fitter, m);
  for (std::size_t i = 0; i < plan.objects.size(); ++i) {
    rule.offset = plan.objects[i].centre;
    place_all(plan.objects[i].placements, rule, fitter, flat.objects[i]);
  }
  m.scene_hash = scene_hash(flat);
  return flat;
}

}  // namespace vitrail
