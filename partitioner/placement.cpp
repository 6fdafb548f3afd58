// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placement.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace vitrail {

namespace {

using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t grain = 8192;  // triangles

Point3d world_vertex(const Placement& p, std::size_t triangle, std::size_t corner) {
  return transform_point(p.to_world, cast<double>(p.mesh->positions[p.mesh->triangles[triangle][corner]]));
}

// Equal coordinates are to have equal bits: −0 + 0 is 0, everything else stays.
Point3f without_negative_zero(Point3d p) {
  const Point3f f = cast<float>(p);
  return {f.x + 0.0f, f.y + 0.0f, f.z + 0.0f};
}

Triangle place_triangle(const Placement& p, std::size_t i, Vector3d offset) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = without_negative_zero(world_vertex(p, i, k) - offset);
  if (p.flip) std::swap(t[1], t[2]);
  return t;
}

// The three codes of a triangle whose corners have these normals, turned to its front.
CornerNormals encode_corner_normals(const Triangle& t, std::array<Normal3d, 3> normals) {
  const Vector3d front =
      cross(cast<double>(t[1]) - cast<double>(t[0]), cast<double>(t[2]) - cast<double>(t[0]));
  Vector3d sum;
  for (const Normal3d& n : normals) sum = sum + normalize(to_vector(n));
  CornerNormals codes;
  for (std::size_t k = 0; k < 3; ++k) {
    codes[k] = encode_normal(dot(sum, front) < 0 ? -normals[k] : normals[k]);
    if (codes[k] == no_normal) return {no_normal, no_normal, no_normal};
  }
  return codes;
}

CornerNormals place_normals(const Placement& p, std::size_t i, const Triangle& t) {
  if (p.mesh->normals.empty()) return {no_normal, no_normal, no_normal};
  std::array<Normal3d, 3> normals;
  for (std::size_t k = 0; k < 3; ++k)
    normals[k] = transform_normal(p.to_world, cast<double>(p.mesh->normals[p.mesh->triangles[i][k]]));
  if (p.flip) std::swap(normals[1], normals[2]);
  return encode_corner_normals(t, normals);
}

// Where a mesh has none, pbrt's, which every triangle has.
CornerUvs place_uvs(const Placement& p, std::size_t i) {
  CornerUvs uv{{{0, 0}, {1, 0}, {1, 1}}};
  for (std::size_t k = 0; k < 3 && !p.mesh->uvs.empty(); ++k) uv[k] = p.mesh->uvs[p.mesh->triangles[i][k]];
  if (p.flip) std::swap(uv[1], uv[2]);
  return uv;
}

void place_attribute(const Placement& p, const MeshAttribute& attribute, TextureUse use,
                     const ReflectanceFitter& fitter, std::span<CornerValues> out) {
  const auto channels = static_cast<std::size_t>(attribute.channels);
  for (std::size_t i = 0; i < p.mesh->triangles.size(); ++i) {
    CornerValues& corners = out[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const float* value = &attribute.values[(attribute.per_face ? i : p.mesh->triangles[i][k]) * channels];
      corners[k] =
          attribute_value({value[0], value[channels > 1 ? 1 : 0], value[channels > 2 ? 2 : 0]}, use, fitter);
    }
    if (p.flip) std::swap(corners[1], corners[2]);
  }
}

// What was placed in an object's space, where the object stands.
template <class T>
std::array<T, 3> stood(const Standing& standing, const std::array<T, 3>& corners, const auto& stand) {
  std::array<T, 3> there;
  const bool mirrored = mirrors(standing.to_bundle);
  for (std::size_t k = 0; k < 3; ++k) there[k] = stand(corners[source_corner(mirrored, k)]);
  return there;
}

constexpr auto as_it_is = [](const auto& value) { return value; };

std::int32_t new_id(const std::vector<std::int32_t>& ids, const auto& old) {
  return old ? ids.at(old->value) : -1;
}

}  // namespace

Placement placement_of(const TriangleMesh& mesh, const Shape& shape, const Transform& outer,
                       std::uint64_t first_triangle) {
  return {&mesh, &shape, outer * shape.object_to_world, shape.flip_orientation != swaps_handedness(outer),
          first_triangle};
}

Bounds3d world_bounds(const Placement& p) {
  return tbb::parallel_reduce(
      Range(0, p.mesh->triangles.size(), grain), Bounds3d{},
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

namespace {

void stand(const Standing& s, PlacedTriangles& out, std::uint64_t at, std::size_t count) {
  tbb::parallel_for(Range(at, at + count, grain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      out.triangles[i] = stood(s, out.triangles[i], [&](Point3f p) { return placed(s.to_bundle, p); });
      if (!out.normals.empty())
        out.normals[i] =
            stood(s, out.normals[i], [&](std::uint32_t code) { return placed_normal(s.to_bundle, code); });
      if (!out.uvs.empty()) out.uvs[i] = stood(s, out.uvs[i], as_it_is);
      for (auto& slot : out.attributes) slot[i] = stood(s, slot[i], as_it_is);
    }
  });
}

}  // namespace

PlacedTriangles make_room(const PlacementRule& rule, std::uint64_t triangles) {
  PlacedTriangles placed;
  placed.triangles.resize(triangles);
  if (rule.normals) placed.normals.resize(triangles);
  if (rule.uvs) placed.uvs.resize(triangles);
  placed.attributes.resize(rule.attributes.size());
  for (auto& slot : placed.attributes) slot.resize(triangles);
  return placed;
}

void place(const Placement& p, const PlacementRule& rule, const ReflectanceFitter& fitter,
           PlacedTriangles& out, std::uint64_t at) {
  const std::size_t count = p.mesh->triangles.size();
  tbb::parallel_for(Range(0, count, grain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Triangle t = out.triangles[at + i] =
          place_triangle(p, i, p.standing ? p.standing->centre : rule.offset);
      if (rule.normals) out.normals[at + i] = place_normals(p, i, t);
      if (rule.uvs) out.uvs[at + i] = place_uvs(p, i);
    }
  });
  for (std::size_t slot = 0; slot < rule.attributes.size(); ++slot)
    for (const MeshAttribute& attribute : p.mesh->attributes)
      if (attribute.name == rule.attributes[slot].name)
        place_attribute(p, attribute, rule.attributes[slot].use, fitter,
                        std::span(out.attributes[slot]).subspan(at, count));
  if (p.standing) stand(*p.standing, out, at, count);
}

Surface surface_of(const Placement& p, const Appearance& appearance) {
  const std::uint32_t material = p.shape->material.value;
  Surface surface{static_cast<std::uint32_t>(p.first_triangle),
                  static_cast<std::uint32_t>(appearance.material_ids.at(material)),
                  new_id(appearance.area_light_ids, p.shape->area_light),
                  new_id(appearance.medium_ids, p.shape->interior),
                  new_id(appearance.medium_ids, p.shape->exterior)};
  if (!p.shape->interior && appearance.material_interiors.at(material) >= 0)
    surface.interior = appearance.material_interiors[material];
  return surface;
}

}  // namespace vitrail
