// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/lamps_off.h"

#include "importers/reading/coincident_lamps.h"
#include "scene/records/light_traits.h"

namespace vitrail {

void turn_off_lamps(ImportedScene& imported) {
  drop_coincident_lamps(imported);  // the same surfaces as with the lamps on
  Scene& scene = imported.scene;
  const auto note = [&](const char* what, const Origin& origin, RecordKind kind) {
    const SourceLocation place = location(scene, origin);
    imported.diagnostics.push_back({Fidelity::dropped, what, place, place, kind});
  };
  for (const AreaLight& light : scene.area_lights)
    note("a surface's light: --lamps off", light.origin, RecordKind::area_light);
  for (const Light& light : scene.lights)
    if (!traits_of(light.model).is_far()) note("a lamp: --lamps off", light.origin, RecordKind::light);
  std::erase_if(scene.lights, [](const Light& light) { return !traits_of(light.model).is_far(); });
  for (Shape& shape : scene.shapes) shape.area_light.reset();
  for (Prototype& prototype : scene.prototypes)
    for (Shape& shape : prototype.shapes) shape.area_light.reset();
  scene.area_lights.clear();
  for (Medium& medium : scene.media) {
    if (medium.emission || medium.temperature)
      note("a medium's light: --lamps off", medium.origin, RecordKind::medium);
    medium.emission.reset(), medium.emission_scale.reset(), medium.temperature.reset();
  }
}

}  // namespace vitrail
