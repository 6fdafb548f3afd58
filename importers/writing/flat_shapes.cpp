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

void note_geometry_only(ConversionNotes& notes) {
  const Scene& scene = notes.scene;
  if (scene.camera_origin.line > 0)
    notes.dropped("camera: the format has none", scene.camera_origin, RecordKind::camera);
  if (scene.film_origin.line > 0)
    notes.dropped("film: the format has none", scene.film_origin, RecordKind::film);
  for (const Light& light : scene.lights)
    notes.dropped("light: the format has surfaces only", light.origin, RecordKind::light);
  for (const Medium& medium : scene.media)
    notes.dropped(fmt::format("medium {}: the format has surfaces only", medium.name), medium.origin,
                  RecordKind::medium);
  if (!scene.instances.empty())
    notes.approximated(
        fmt::format("{} instances: each is written with triangles of its own", scene.instances.size()),
        scene.instances.front().origin, RecordKind::instance);
}

void note_quadrics(const std::vector<FlatShape>& shapes, ConversionNotes& notes) {
  std::unordered_set<const Shape*> noted;  // of many instances one shape
  for (const FlatShape& flat : shapes) {
    const std::optional<Quadric>& quadric = notes.scene.meshes.at(flat.shape.mesh.value).quadric;
    if (quadric && noted.insert(&flat.shape).second)
      notes.approximated(as_triangles(*quadric), flat.shape.origin, RecordKind::shape);
  }
}

}  // namespace vitrail
