// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "importers/mitsuba/clip_units.h"
#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/reading/clip_planes.h"

namespace vitrail::mitsuba {

void read_clipping(Builder& b, const Object& sensor) {
  for (const auto& [name, value] :
       {std::pair{"near_clip", &b.clipping.near_clip}, {"far_clip", &b.clipping.far_clip}})
    *value = sensor.number(name, *value, b.report);
  const double near_clip = b.clipping.near_clip, far_clip = b.clipping.far_clip;
  if (!(near_clip > 0 && near_clip < far_clip))
    b.report.fail(
        fmt::format("near_clip, {:g}, has to be above 0 and below far_clip, {:g}", near_clip, far_clip),
        place_of(sensor, sensor.has("near_clip") ? "near_clip" : "far_clip"));
}

void keep_clipping(Builder& b) {
  ClipRange planes = from_mitsuba(
      {static_cast<float>(b.clipping.near_clip), static_cast<float>(b.clipping.far_clip)}, b.scene.camera);
  const auto unit = static_cast<float>(depth_unit(b.scene.camera));
  const ClipRange wide =
      wide_clip(b.scene, std::visit([](const auto& c) { return c.camera_to_world; }, b.scene.camera));
  if (planes.near * unit <= wide.near) planes.near = ClipRange{}.near;
  if (planes.far * unit >= wide.far) planes.far = ClipRange{}.far;
  keep_clip(b.scene, planes);
}

}  // namespace vitrail::mitsuba
