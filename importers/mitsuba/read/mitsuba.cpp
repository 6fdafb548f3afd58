// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/mitsuba.h"

#include <fmt/format.h>

#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/light_samples.h"
#include "importers/mitsuba/read/load.h"
#include "importers/reading/default_view.h"

namespace vitrail {

namespace mitsuba {

// Interfaces are no events here; Mitsuba's volumetric integrators alone agree.
static void report_null_depth(Builder& b) {
  const RenderSettings& settings = b.scene.settings;
  if (!settings.straight_counts || settings.max_depth >= unlimited_depth) return;
  for (const Material& material : b.scene.materials)
    if (std::holds_alternative<InterfaceMaterial>(material.model))
      b.report.approximated("the depth: going through \"null\" does not count", material.origin);
}

// Of which the scene's camera is one.
static void read_sensors(Builder& b, const Object& root, int chosen) {
  const std::vector<const Property*> sensors = root.children("sensor");
  const auto number = static_cast<std::size_t>(chosen);
  if (number > 0 && number >= sensors.size())
    throw UsageError(
        fmt::format("--camera {}: the scene has {} sensors, counted from 0", chosen, sensors.size()));
  if (sensors.size() > 1)
    b.report.dropped(fmt::format("a scene has one camera: sensor {} of {}, from 0", chosen, sensors.size()),
                     sensors[number == 0 ? 1 : 0]->origin);
  if (sensors.empty()) return;
  b.report.begin_item({sensors[number]->origin, RecordKind::camera});
  read_sensor(b, *std::get<ObjectPtr>(sensors[number]->value));
}

// To those, what bumps are around lets no light of emitters straight through.
static void report_dark_bumps(Builder& b) {
  if (b.scene.settings.straight_counts) return;
  for (const Origin& place : b.bumps_of_straight) {
    b.report.begin_item({place, RecordKind::material});
    b.report.approximated("light goes through what these bumps are on as it does without them", place);
  }
}

static void build(Builder& b, const Object& root, const ImportOptions& options) {
  // Objects that others refer to come first, so that they have their places in the order of the file.
  for (const Property& p : root.properties) {
    const auto* object = std::get_if<ObjectPtr>(&p.value);
    if (!object) continue;
    b.report.begin_item({(*object)->origin});
    const std::string& tag = (*object)->tag;
    if (tag == "bsdf") add_material(b, **object);
    if (tag == "medium") add_medium(b, **object);
    if (tag == "bsdf" || tag == "medium" || tag == "texture" || tag == "spectrum" || tag == "volume" ||
        tag == "phase")
      p.queried = true;  // used where something refers to it
  }
  for (const Property* p : root.children("integrator")) read_integrator(b, *std::get<ObjectPtr>(p->value));
  read_sensors(b, root, options.camera);
  for (const Property& p : root.properties) {
    const auto* object = std::get_if<ObjectPtr>(&p.value);
    if (!object) continue;
    b.report.begin_item({(*object)->origin});
    if ((*object)->tag == "emitter") p.queried = true, add_emitter(b, **object);
    if ((*object)->tag == "shape") p.queried = true, add_shape(b, **object);
  }
  multiply_by_samples(b, root);
  report_null_depth(b);
  report_dark_bumps(b);
  finish_integrator(b, options.all_media);
  keep_clipping(b);
  root.ignore({"camera", "version"});
  root.children("sampler");
  root.children("film");
  report_unused(root, b.report);
}

}  // namespace mitsuba

ImportedScene read_mitsuba(const std::filesystem::path& file, MeshMemory memory,
                           const ImportOptions& options) {
  ImportedScene imported;
  mitsuba::Report report(imported.scene.files);
  if (memory.is_limited()) report.count_repeated();
  const mitsuba::ObjectPtr root = mitsuba::load(file, options, imported.scene.files, report);
  mitsuba::Builder builder{imported.scene, report};
  builder.mesh_memory = std::move(memory);
  builder.replace_missing = options.replace_missing;
  build(builder, *root, options);
  imported.diagnostics = report.take();
  if (root->children("sensor").empty()) add_default_view(imported, file);
  return imported;
}

}  // namespace vitrail
