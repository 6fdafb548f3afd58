// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

namespace {

bool is_cut(const Clipping& clipping, double depth) {
  return (depth > 0 && depth < clipping.near_clip) || depth > clipping.far_clip;
}

}  // namespace

void report_clipping(Builder& b) {
  if (!b.clipping.place) return;
  const auto* camera = std::get_if<PerspectiveCamera>(&b.scene.camera);
  if (!camera) return;
  const Transform to_camera = inverse(camera->camera_to_world);
  for (const Shape& shape : b.scene.shapes) {
    const Transform to = to_camera * shape.object_to_world;
    for (const Point3f p : b.scene.meshes[shape.mesh.value].positions) {
      if (!is_cut(b.clipping, transform_point(to, cast<double>(p)).z)) continue;
      b.report.begin_item({*b.clipping.place, RecordKind::camera});
      return b.report.approximated(
          fmt::format("what is nearer than near_clip, {:g}, or farther than far_clip, {:g}, is seen",
                      b.clipping.near_clip, b.clipping.far_clip),
          *b.clipping.place);
    }
  }
}

}  // namespace vitrail::mitsuba
