// SPDX-License-Identifier: Apache-2.0
#include "partitioner/flatten.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>

#include "bundle/checksum.h"
#include "bundle/interiors.h"
#include "bundle/records.h"
#include "partitioner/appearance.h"
#include "partitioner/requirements.h"

namespace vitrail {

namespace {

using Range = tbb::blocked_range<std::size_t>;

// One shape where it stands in the world.
struct Placement {
  const TriangleMesh* mesh = nullptr;
  const Shape* shape = nullptr;
  Transform to_world;
  bool flip = false;  // the world winding shows the back
  std::uint64_t first_triangle = 0;
};

std::vector<Placement> place(const Scene& scene, std::uint64_t& triangles) {
  std::vector<Placement> placements;
  triangles = 0;
  const auto add = [&](const Shape& shape, const Transform& outer, bool mirrored) {
    const TriangleMesh& mesh = scene.meshes.at(shape.mesh.value);
    if (mesh.triangles.empty()) return;
    const Transform to_world = outer * shape.object_to_world;
    placements.push_back({&mesh, &shape, to_world, shape.flip_orientation != mirrored, triangles});
    triangles += mesh.triangles.size();
  };
  for (const Shape& shape : scene.shapes) add(shape, {}, false);
  for (const Instance& instance : scene.instances)
    for (const Shape& shape : scene.prototypes.at(instance.prototype.value).shapes)
      add(shape, instance.prototype_to_world, swaps_handedness(instance.prototype_to_world));
  if (triangles >= no_triangle)
    throw Error(fmt::format("the scene has {} triangles with all instances; the most is {}", triangles,
                            no_triangle - 1));
  return placements;
}

Point3d world_vertex(const Placement& p, std::size_t triangle, std::size_t corner) {
  return transform_point(p.to_world, cast<double>(p.mesh->positions[p.mesh->triangles[triangle][corner]]));
}

Bounds3d world_bounds(const Placement& p) {
  return tbb::parallel_reduce(
      Range(0, p.mesh->triangles.size(), 8192), Bounds3d{},
      [&](const Range& range, Bounds3d b) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
          for (std::size_t k = 0; k < 3; ++k) {
            const Point3d v = world_vertex(p, i, k);
            if (!is_finite(cast<float>(v)))
              throw Error(fmt::format(
                  "triangle {} of a shape (global triangle {}) has the vertex ({}, {}, {}) in the "
                  "world; every coordinate has to be finite and below 3.4e38",
                  i, p.first_triangle + i, v.x, v.y, v.z));
            extend(b, v);
          }
        return b;
      },
      [](Bounds3d a, const Bounds3d& b) {
        extend(a, b);
        return a;
      });
}

Vector3d offset_of(const std::vector<Placement>& placements) {
  Bounds3d bounds;
  for (const Placement& p : placements) extend(bounds, world_bounds(p));
  if (bounds.empty()) return {};
  const Point3f c = cast<float>(center(bounds));
  return {c.x, c.y, c.z};
}

// Equal coordinates are to have equal bits: −0 + 0 is 0, everything else stays.
Point3f without_negative_zero(Point3d p) {
  const Point3f f = cast<float>(p);
  return {f.x + 0.0f, f.y + 0.0f, f.z + 0.0f};
}

void place_triangles(const Placement& p, Vector3d offset, std::vector<Triangle>& triangles) {
  tbb::parallel_for(Range(0, p.mesh->triangles.size(), 8192), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      Triangle& t = triangles[p.first_triangle + i];
      for (std::size_t k = 0; k < 3; ++k) t[k] = without_negative_zero(world_vertex(p, i, k) - offset);
      if (p.flip) std::swap(t[1], t[2]);
    }
  });
}

// The three codes of a triangle whose corners have these normals, turned to its front.
std::array<std::uint32_t, 3> encode_corner_normals(const Triangle& t, std::array<Normal3d, 3> normals) {
  const Vector3d front =
      cross(cast<double>(t[1]) - cast<double>(t[0]), cast<double>(t[2]) - cast<double>(t[0]));
  Vector3d sum;
  for (const Normal3d& n : normals) sum = sum + normalize(to_vector(n));
  std::array<std::uint32_t, 3> codes;
  for (std::size_t k = 0; k < 3; ++k) {
    codes[k] = encode_normal(dot(sum, front) < 0 ? -normals[k] : normals[k]);
    if (codes[k] == no_normal) return {no_normal, no_normal, no_normal};
  }
  return codes;
}

void place_normals(const Placement& p, FlatScene& flat) {
  if (p.mesh->normals.empty()) return;
  tbb::parallel_for(Range(0, p.mesh->triangles.size(), 8192), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      std::array<Normal3d, 3> normals;
      for (std::size_t k = 0; k < 3; ++k)
        normals[k] = transform_normal(p.to_world, cast<double>(p.mesh->normals[p.mesh->triangles[i][k]]));
      if (p.flip) std::swap(normals[1], normals[2]);
      const std::size_t id = p.first_triangle + i;
      flat.normals[id] = encode_corner_normals(flat.triangles[id], normals);
    }
  });
}

void place_uvs(const Placement& p, FlatScene& flat) {
  if (p.mesh->uvs.empty()) {  // pbrt's, which every triangle has
    for (std::size_t i = 0; i < p.mesh->triangles.size(); ++i)
      flat.uvs[p.first_triangle + i] = {
          {{0, 0}, p.flip ? Point2f{1, 1} : Point2f{1, 0}, p.flip ? Point2f{1, 0} : Point2f{1, 1}}};
    return;
  }
  tbb::parallel_for(Range(0, p.mesh->triangles.size(), 8192), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      std::array<Point2f, 3>& uv = flat.uvs[p.first_triangle + i];
      for (std::size_t k = 0; k < 3; ++k) uv[k] = p.mesh->uvs[p.mesh->triangles[i][k]];
      if (p.flip) std::swap(uv[1], uv[2]);
    }
  });
}

void place_attribute(const Placement& p, const TextureBaker::Attribute& slot, const ReflectanceFitter& fitter,
                     std::vector<std::array<std::array<float, 3>, 3>>& values) {
  for (const MeshAttribute& attribute : p.mesh->attributes) {
    if (attribute.name != slot.name) continue;
    const auto channels = static_cast<std::size_t>(attribute.channels);
    for (std::size_t i = 0; i < p.mesh->triangles.size(); ++i) {
      auto& corners = values[p.first_triangle + i];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = attribute.per_face ? i : p.mesh->triangles[i][k];
        const float* value = &attribute.values[at * channels];
        corners[k] = attribute_value({value[0], value[channels > 1 ? 1 : 0], value[channels > 2 ? 2 : 0]},
                                     slot.use, fitter);
      }
      if (p.flip) std::swap(corners[1], corners[2]);
    }
  }
}

std::int32_t new_id(const std::vector<std::int32_t>& ids, const auto& old) {
  return old ? ids.at(old->value) : -1;
}

void make_surfaces(const Appearance& appearance, const std::vector<Placement>& placements, Manifest& m) {
  for (const Placement& p : placements) {
    const std::uint32_t material = p.shape->material.value;
    Surface surface{static_cast<std::uint32_t>(p.first_triangle),
                    static_cast<std::uint32_t>(appearance.material_ids.at(material)),
                    new_id(appearance.area_light_ids, p.shape->area_light),
                    new_id(appearance.medium_ids, p.shape->interior),
                    new_id(appearance.medium_ids, p.shape->exterior)};
    if (!p.shape->interior && appearance.material_interiors.at(material) >= 0)
      surface.interior = appearance.material_interiors[material];
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
  const std::vector<Placement> placements = place(scene, m.triangles);
  m.offset = offset_of(placements);
  make_surfaces(appearance, placements, m);
  const std::vector<TextureBaker::Attribute>& slots = appearance.attributes;
  move_records(scene, appearance, m);
  static_cast<void>(Interiors(m));  // throws where there are too many
  m.requirements = everything ? all_requirements() : requirements_of(m, has_normals(placements, scene));

  const ReflectanceFitter fitter;
  flat.triangles.resize(m.triangles);
  if (m.requirements.shading_normals) flat.normals.assign(m.triangles, {no_normal, no_normal, no_normal});
  if (m.requirements.uv) flat.uvs.resize(m.triangles);
  flat.attributes.resize(slots.size());
  for (auto& slot : flat.attributes) slot.resize(m.triangles);
  for (const Placement& p : placements) {
    place_triangles(p, m.offset, flat.triangles);
    if (m.requirements.shading_normals) place_normals(p, flat);
    if (m.requirements.uv) place_uvs(p, flat);
    for (std::size_t i = 0; i < slots.size(); ++i) place_attribute(p, slots[i], fitter, flat.attributes[i]);
  }
  for (const Triangle& t : flat.triangles)
    for (const Point3f& v : t) extend(m.bounds, v);
  for (int axis = 0; axis < 3 && m.triangles > 0; ++axis)
    m.scale = std::max({m.scale, std::abs(m.bounds.lower[axis]), std::abs(m.bounds.upper[axis])});
  make_emissive_triangles(flat);
  m.scene_hash = scene_hash(flat);
  return flat;
}

}  // namespace vitrail
