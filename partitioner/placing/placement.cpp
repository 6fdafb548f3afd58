// SPDX-License-Identifier: Apache-2.0
#include "partitioner/placing/placement.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

#include "scene/records/curve_uses.h"
#include "scene/system/huge_pages.h"

namespace vitrail {

namespace {

using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t grain = 8192;  // triangles or vertices

Point3d world_position(const Placement& p, Point3f v) { return transform_point(p.to_world, cast<double>(v)); }

// Equal coordinates are to have equal bits: −0 + 0 is 0, everything else stays.
Point3f without_negative_zero(Point3d p) {
  const Point3f f = cast<float>(p);
  return {f.x + 0.0f, f.y + 0.0f, f.z + 0.0f};
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

// What was placed in an object's space, where the object stands.
template <class T>
std::array<T, 3> stood(bool mirrored, const std::array<T, 3>& corners, const auto& stand) {
  std::array<T, 3> there;
  for (std::size_t k = 0; k < 3; ++k) there[k] = stand(corners[source_corner(mirrored, k)]);
  return there;
}

void stand(const Standing& s, PlacedTriangles& out, std::uint64_t begin, std::uint64_t end) {
  const bool mirrored = mirrors(s.to_bundle);
  const auto as_it_is = [](const auto& value) { return value; };
  for (std::uint64_t i = begin; i != end; ++i) {
    out.triangles[i] = stood(mirrored, out.triangles[i], [&](Point3f p) { return placed(s.to_bundle, p); });
    if (!out.normals.empty())
      out.normals[i] = stood(mirrored, out.normals[i],
                             [&](std::uint32_t code) { return placed_normal(s.to_bundle, code); });
    if (!out.uvs.empty()) out.uvs[i] = stood(mirrored, out.uvs[i], as_it_is);
    for (auto& slot : out.attributes) slot[i] = stood(mirrored, slot[i], as_it_is);
  }
}

std::int32_t new_id(const std::vector<std::int32_t>& ids, const auto& old) {
  return old ? ids.at(old->value) : -1;
}

}  // namespace

Placement placement_of(const TriangleMesh& mesh, const Shape& shape, const Transform& outer,
                       std::uint64_t first_triangle) {
  return {&mesh, &shape, outer * shape.object_to_world, shape.flip_orientation != swaps_handedness(outer),
          first_triangle};
}

PlacedTriangles make_room(const PlacementRule& rule, std::uint64_t triangles) {
  PlacedTriangles placed;
  reserve_huge(placed.triangles, triangles);
  placed.triangles.resize(triangles);
  if (rule.normals) placed.normals.resize(triangles);
  if (rule.uvs) placed.uvs.resize(triangles);
  placed.attributes.resize(rule.attributes.size());
  for (auto& slot : placed.attributes) slot.resize(triangles);
  return placed;
}

MeshPlacer::MeshPlacer(const Placement& placement, const TriangleMesh& mesh, const PlacementRule& rule,
                       const ReflectanceFitter& fitter)
    : placement_(placement), mesh_(mesh), rule_(rule), fitter_(fitter), vertices_(mesh.positions.size()) {
  const Vector3d offset = placement.standing ? placement.standing->centre : rule.offset;
  tbb::parallel_for(Range(0, vertices_.size(), grain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      vertices_[i] = without_negative_zero(world_position(placement, mesh.positions[i]) - offset);
  });
}

void MeshPlacer::reject(std::size_t i) const {
  for (const std::uint32_t corner : mesh_.triangles[i]) {
    if (is_finite(vertices_[corner])) continue;
    const Point3d v = world_position(placement_, mesh_.positions[corner]);
    throw Error(
        fmt::format("triangle {} of a shape (global triangle {}) has the vertex ({}, {}, {}) in the "
                    "world; every coordinate has to be finite and below 3.4e38",
                    i, placement_.first_triangle + i, v.x, v.y, v.z));
  }
  throw std::logic_error("no vertex to reject");
}

Triangle MeshPlacer::triangle(std::size_t i) const {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = vertices_[mesh_.triangles[i][k]];
  if (!(is_finite(t[0]) && is_finite(t[1]) && is_finite(t[2]))) reject(i);
  if (placement_.flip) std::swap(t[1], t[2]);
  return t;
}

CornerNormals MeshPlacer::normals(std::size_t i, const Triangle& placed) const {
  if (mesh_.normals.empty()) return {no_normal, no_normal, no_normal};
  std::array<Normal3d, 3> normals;
  for (std::size_t k = 0; k < 3; ++k)
    normals[k] = transform_normal(placement_.to_world, cast<double>(mesh_.normals[mesh_.triangles[i][k]]));
  if (placement_.flip) std::swap(normals[1], normals[2]);
  return encode_corner_normals(placed, normals);
}

CornerUvs MeshPlacer::uvs(std::size_t i) const {
  CornerUvs uv = uvs_of(mesh_, i);
  if (placement_.flip) std::swap(uv[1], uv[2]);
  return uv;
}

CornerValues MeshPlacer::values(std::size_t i, const MeshAttribute& attribute,
                                const TextureBaker::Attribute& wanted) const {
  const auto channels = static_cast<std::size_t>(attribute.channels);
  CornerValues corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* value = &attribute.values[(attribute.per_face ? i : mesh_.triangles[i][k]) * channels];
    const auto tinted = [&](std::size_t c) {
      return static_cast<double>(value[std::min(c, channels - 1)] * wanted.tint[c]);
    };
    corners[k] = attribute_value({tinted(0), tinted(1), tinted(2)}, wanted.use, fitter_);
  }
  if (placement_.flip) std::swap(corners[1], corners[2]);
  return corners;
}

// Of the corners, among the tiles.
CornerValues MeshPlacer::tile_places(std::size_t i, const PtexTiles& tiles) const {
  const CornerUvs uv = uvs_of(mesh_, i);
  const auto faces = std::ranges::find(mesh_.attributes, face_indices, &MeshAttribute::name);
  const float face = faces == mesh_.attributes.end() ? 0 : faces->values[i];
  CornerValues corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2f place = tiles.at(face, uv[k]);
    corners[k] = {place.x, place.y, 0};
  }
  if (placement_.flip) std::swap(corners[1], corners[2]);
  return corners;
}

void MeshPlacer::place(std::size_t begin, std::size_t end, PlacedTriangles& out, std::uint64_t at) const {
  for (std::size_t i = begin; i != end; ++i) {
    const std::uint64_t to = at + (i - begin);
    const Triangle t = out.triangles[to] = triangle(i);
    if (rule_.normals) out.normals[to] = normals(i, t);
    if (rule_.uvs) out.uvs[to] = uvs(i);
  }
  for (std::size_t slot = 0; slot < rule_.attributes.size(); ++slot) {
    const TextureBaker::Attribute& wanted = rule_.attributes[slot];
    const auto put = [&](const auto& value) {
      for (std::size_t i = begin; i != end; ++i) out.attributes[slot][at + (i - begin)] = value(i);
    };
    if (wanted.tiles) {
      put([&](std::size_t i) { return tile_places(i, *wanted.tiles); });
      continue;
    }
    for (const MeshAttribute& attribute : mesh_.attributes)
      if (attribute.name == wanted.name) put([&](std::size_t i) { return values(i, attribute, wanted); });
  }
  if (placement_.standing) stand(*placement_.standing, out, at, at + (end - begin));
}

void place(const Placement& p, const PlacementRule& rule, const ReflectanceFitter& fitter,
           PlacedTriangles& out, std::uint64_t at) {
  const MeshPlacer placer(p, *p.mesh, rule, fitter);
  tbb::parallel_for(Range(0, p.mesh->triangles.size(), grain), [&](const Range& range) {
    placer.place(range.begin(), range.end(), out, at + range.begin());
  });
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
  const auto* texture = std::get_if<Id<Texture>>(&p.shape->opacity);
  surface.opacity = texture ? appearance.opacities.at(texture->value) : p.shape->opacity;
  // What shines shows its outer wall alone, as much of it as the curve.
  if (!p.tube || p.shape->area_light) return surface;
  if (const std::int32_t outer = appearance.outer_wall_ids.at(material); outer >= 0)
    surface.material = static_cast<std::uint32_t>(outer);
  else if (const auto* opacity = std::get_if<float>(&surface.opacity))
    surface.opacity = opacity_of_wall(*opacity);
  return surface;
}

}  // namespace vitrail
