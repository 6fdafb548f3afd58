// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/flat_shapes.h"

#include <fmt/format.h>

#include <unordered_set>

#include "importers/writing/placed_quadric.h"

namespace vitrail {

std::vector<FlatShape> flat_shapes(const Scene& scene) {
  constexpr std::size_t most = 1 << 26;  // 10 GB
  std::size_t count = scene.shapes.size();
  for (const Instance& instance : scene.instances)
    count += scene.prototypes.at(instance.prototype.value).shapes.size();
  if (count > most)
    throw Error(fmt::format("instances stand for {} shapes: too many to be copied into one file", count));
  std::vector<FlatShape> flat;
  flat.reserve(count);
  for (const Shape& shape : scene.shapes)
    flat.push_back({shape, shape.object_to_world, shape.flip_orientation});
  for (const Instance& instance : scene.instances) {
    // A mirrored instance keeps the fronts of its prototype.
    const bool mirrors = swaps_handedness(instance.prototype_to_world);
    for (const Shape& shape : scene.prototypes.at(instance.prototype.value).shapes)
      flat.push_back(
          {shape, instance.prototype_to_world * shape.object_to_world, shape.flip_orientation != mirrors});
  }
  return flat;
}

void note_geometry_only(const Scene& scene, Diagnostics& diagnostics) {
  const auto note = [&](Fidelity fidelity, std::string message, RecordKind kind, const Origin& origin) {
    const SourceLocation where = location(scene, origin);
    diagnostics.push_back({fidelity, std::move(message), where, where, kind});
  };
  if (scene.camera_origin.line > 0)
    note(Fidelity::dropped, "camera: the format has none", RecordKind::camera, scene.camera_origin);
  if (scene.film_origin.line > 0)
    note(Fidelity::dropped, "film: the format has none", RecordKind::film, scene.film_origin);
  for (const Light& light : scene.lights)
    note(Fidelity::dropped, "light: the format has surfaces only", RecordKind::light, light.origin);
  for (const Medium& medium : scene.media)
    note(Fidelity::dropped, fmt::format("medium {}: the format has surfaces only", medium.name),
         RecordKind::medium, medium.origin);
  if (!scene.instances.empty())
    note(Fidelity::approximated,
         fmt::format("{} instances: each is written with triangles of its own", scene.instances.size()),
         RecordKind::instance, scene.instances.front().origin);
}

void note_quadrics(const Scene& scene, const std::vector<FlatShape>& shapes, Diagnostics& diagnostics) {
  std::unordered_set<const Shape*> noted;
  for (const FlatShape& flat : shapes) {
    const std::optional<Quadric>& quadric = scene.meshes.at(flat.shape.mesh.value).quadric;
    if (!quadric || !noted.insert(&flat.shape).second) continue;
    const SourceLocation where = location(scene, flat.shape.origin);
    diagnostics.push_back({Fidelity::approximated, as_triangles(*quadric), where, where, RecordKind::shape});
  }
}

}  // namespace vitrail
