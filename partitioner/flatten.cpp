// SPDX-License-Identifier: Apache-2.0
#include "partitioner/flatten.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <map>

#include "bundle/checksum.h"
#include "bundle/records.h"
#include "partitioner/appearance.h"

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

// Gives the records that are used new ids in the order of their first use.
template <class T>
struct Compacted {
  const std::vector<T>& all;
  std::vector<T>& used;
  std::map<std::uint32_t, std::uint32_t> ids{};
  std::uint32_t id(std::uint32_t old) {
    const auto [at, is_new] = ids.try_emplace(old, static_cast<std::uint32_t>(used.size()));
    if (is_new) used.push_back(all.at(old));
    return at->second;
  }
};

void make_surfaces(const Appearance& appearance, const std::vector<Placement>& placements, Manifest& m) {
  Compacted<bundle::Material> materials{appearance.materials, m.materials};
  Compacted<bundle::AreaLight> area_lights{appearance.area_lights, m.area_lights};
  for (const Placement& p : placements) {
    Surface surface{static_cast<std::uint32_t>(p.first_triangle), materials.id(p.shape->material.value), -1};
    if (p.shape->area_light)
      surface.area_light = static_cast<std::int32_t>(area_lights.id(p.shape->area_light->value));
    const bool same = !m.surfaces.empty() && m.surfaces.back().material == surface.material &&
                      m.surfaces.back().area_light == surface.area_light;
    if (!same) m.surfaces.push_back(surface);
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
      if (length(normal) > 0)
        m.emissive_triangles.push_back({{t[0], t[1], t[2]},
                                        static_cast<std::uint32_t>(id),
                                        static_cast<std::uint32_t>(m.surfaces[s].area_light)});
    }
  }
}

Requirements requirements_of(const std::vector<Placement>& placements, const Appearance& appearance) {
  Requirements r;
  for (const Placement& p : placements) {
    const bundle::Material& material = appearance.materials.at(p.shape->material.value);
    const bool interface = std::holds_alternative<bundle::InterfaceMaterial>(material);
    r.interfaces |= interface;
    r.shading_normals |= !interface && !p.mesh->normals.empty();
    if (const auto* dielectric = std::get_if<bundle::DielectricMaterial>(&material)) {
      r.transmission = true;
      r.dispersion |= !is_constant(dielectric->eta);
    }
  }
  return r;
}

void move_records(const Scene& scene, const Appearance& appearance, Manifest& m) {
  m.lights = appearance.lights;
  for (bundle::Light& light : m.lights)
    if (auto* point = std::get_if<bundle::PointLight>(&light)) point->position = point->position - m.offset;
  m.camera = appearance.camera;
  std::visit([&](auto& c) { c.camera_to_world = translate(-m.offset) * c.camera_to_world; }, m.camera);
  m.film = scene.film;
  m.settings = scene.settings;
}

std::uint64_t scene_hash(const FlatScene& flat) {
  const std::uint64_t records = hash_of_records(flat.manifest);
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(flat.triangles)));
  hasher.add(std::as_bytes(std::span(flat.normals)));
  hasher.add(std::as_bytes(std::span(&records, 1)));
  return hasher.digest();
}

}  // namespace

FlatScene flatten(const Scene& scene) {
  FlatScene flat;
  Manifest& m = flat.manifest;
  const Appearance appearance = appearance_of(scene);
  const std::vector<Placement> placements = place(scene, m.triangles);
  m.offset = offset_of(placements);
  m.requirements = requirements_of(placements, appearance);
  flat.triangles.resize(m.triangles);
  if (m.requirements.shading_normals) flat.normals.assign(m.triangles, {no_normal, no_normal, no_normal});
  for (const Placement& p : placements) {
    place_triangles(p, m.offset, flat.triangles);
    if (m.requirements.shading_normals) place_normals(p, flat);
  }
  for (const Triangle& t : flat.triangles)
    for (const Point3f& v : t) extend(m.bounds, v);
  for (int axis = 0; axis < 3 && m.triangles > 0; ++axis)
    m.scale = std::max({m.scale, std::abs(m.bounds.lower[axis]), std::abs(m.bounds.upper[axis])});
  make_surfaces(appearance, placements, m);
  make_emissive_triangles(flat);
  move_records(scene, appearance, m);
  m.scene_hash = scene_hash(flat);
  return flat;
}

}  // namespace vitrail
