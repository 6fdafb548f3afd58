// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/write/write_ply_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "importers/writing/flat_shapes.h"
#include "importers/writing/write_ply.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

class Merger {
 public:
  Merger(const Scene& scene, const std::vector<FlatShape>& shapes) : scene_(scene) {
    for (const FlatShape& flat : shapes) {
      const TriangleMesh& mesh = scene.meshes.at(flat.shape.mesh.value);
      with_normals_ |= mesh.quadric || !mesh.normals.empty();
      with_uvs_ |= mesh.quadric || !mesh.uvs.empty();
    }
  }

  void add(const FlatShape& flat) {
    TriangleMesh storage;
    const TriangleMesh& mesh = loaded(scene_.meshes.at(flat.shape.mesh.value), storage);
    const bool flat_shaded = with_normals_ && mesh.normals.empty();
    flat_shaded ? add_corners(flat, mesh) : add_vertices(flat, mesh);
    if (merged_.positions.size() > 0x7fffffff)
      throw Error("more than 2147483647 vertices: too many for one PLY file");
  }

  const TriangleMesh& merged() const { return merged_; }

 private:
  void add_vertex(const FlatShape& flat, const TriangleMesh& mesh, std::uint32_t i, Normal3f normal) {
    merged_.positions.push_back(
        cast<float>(transform_point(flat.object_to_world, cast<double>(mesh.positions[i]))));
    if (with_normals_) merged_.normals.push_back(normal);
    if (with_uvs_) merged_.uvs.push_back(mesh.uvs.empty() ? Point2f{} : mesh.uvs[i]);
  }

  void add_vertices(const FlatShape& flat, const TriangleMesh& mesh) {
    const auto base = static_cast<std::uint32_t>(merged_.positions.size());
    const bool is_still = flat.object_to_world == Transform{};
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
      Normal3f n;
      if (!mesh.normals.empty()) n = mesh.normals[i];
      if (!is_still)
        n = cast<float>(
            to_normal(normalize(to_vector(transform_normal(flat.object_to_world, cast<double>(n))))));
      add_vertex(flat, mesh, i, n);
    }
    const std::size_t second = flat.flip ? 2 : 1, third = 3 - second;
    for (const auto& t : mesh.triangles)
      merged_.triangles.push_back({base + t[0], base + t[second], base + t[third]});
  }

  void add_corners(const FlatShape& flat, const TriangleMesh& mesh) {
    const std::size_t second = flat.flip ? 2 : 1, third = 3 - second;
    const auto world = [&](std::uint32_t i) {
      return transform_point(flat.object_to_world, cast<double>(mesh.positions[i]));
    };
    for (const auto& t : mesh.triangles) {
      const auto base = static_cast<std::uint32_t>(merged_.positions.size());
      const Point3d a = world(t[0]);
      const Vector3d n = normalize(cross(world(t[second]) - a, world(t[third]) - a));
      for (const std::size_t corner : {std::size_t{0}, second, third})
        add_vertex(flat, mesh, t[corner], cast<float>(to_normal(n)));
      merged_.triangles.push_back({base, base + 1, base + 2});
    }
  }

  const Scene& scene_;
  TriangleMesh merged_;
  bool with_normals_ = false, with_uvs_ = false;
};

// Floats hold 2⁻²⁴ of a coordinate.
bool is_far_from_origin(const TriangleMesh& mesh) {
  Bounds3f bounds;
  for (const Point3f& p : mesh.positions) extend(bounds, p);
  if (bounds.empty()) return false;
  constexpr float far = 64;
  const float half = length(extent(bounds)) / 2;
  return half > 0 && length(center(bounds) - Point3f{}) > far * half;
}

}  // namespace

Diagnostics write_ply_scene(const Scene& scene, const std::filesystem::path& file) {
  ConversionNotes notes(scene);
  note_geometry_only(notes);
  for (const Material& material : scene.materials)
    notes.dropped(fmt::format("material {}: PLY has none", material.name), material.origin,
                  RecordKind::material);
  for (const AreaLight& light : scene.area_lights)
    notes.dropped("area light: PLY has none", light.origin, RecordKind::area_light);
  if (const auto partly = std::ranges::find_if(
          scene.shapes, [](const Shape& s) { return s.opacity != FloatParameter{1.0f}; });
      partly != scene.shapes.end())
    notes.dropped("opacity of shapes: PLY has none", partly->origin);
  if (std::ranges::any_of(scene.meshes, [](const TriangleMesh& m) { return !m.attributes.empty(); }))
    notes.dropped("attributes of meshes: not all shapes have the same");
  const std::vector<FlatShape> shapes = flat_shapes(scene);
  note_quadrics(shapes, notes);
  Merger merger(scene, shapes);
  for (const FlatShape& flat : shapes) merger.add(flat);
  if (shapes.size() > 1) notes.approximated(fmt::format("{} shapes: merged into one mesh", shapes.size()));
  if (is_far_from_origin(merger.merged()))
    notes.approximated("the scene lies far from the origin: its coordinates are rounded to floats");
  write_ply(merger.merged(), file);
  return notes.take();
}

}  // namespace vitrail
