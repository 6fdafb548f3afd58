// SPDX-License-Identifier: Apache-2.0
#include "importers/import.h"

#include <fmt/format.h>

#include <optional>

#include "importers/readers.h"
#include "importers/reading/coincident_lamps.h"
#include "importers/reading/default_view.h"
#include "importers/reading/foreign_text.h"
#include "importers/reading/given_glazing.h"
#include "importers/reading/given_sky.h"
#include "importers/reading/missing_files.h"
#include "scene/records/curve_uses.h"
#include "scene/records/nesting_limits.h"
#include "scene/shapes/curve.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// "Mitsuba", or "Mitsuba and glTF": the formats that have it.
std::string formats_with(bool Reader::*feature) {
  std::string names;
  for (const Reader& reader : readers())
    if (reader.*feature) names += (names.empty() ? "" : " and ") + std::string(reader.name);
  return names;
}

ImportedScene read_scene(const std::filesystem::path& file, MeshMemory memory,
                         std::function<void(double)> progress, const ImportOptions& options) {
  const Reader& reader = reader_of(file);
  if (!options.definitions.empty() && !reader.has_definitions)
    throw UsageError(fmt::format("{}: only scenes of {} have parameters that -D could set", file.string(),
                                 formats_with(&Reader::has_definitions)));
  if (options.camera != 0 && !reader.has_many_cameras)
    throw UsageError(fmt::format("{}: only scenes of {} have more than one camera", file.string(),
                                 formats_with(&Reader::has_many_cameras)));
  ImportedScene imported = reader.read({file, std::move(memory), std::move(progress), options});
  if (!reader.adds_view) add_default_view(imported, file);
  if (options.replace_missing || reader.goes_on_without_images)
    replace_missing_images(imported);
  else
    require_images(imported.scene);
  return imported;
}

void report_tubes(ImportedScene& imported) {
  const Scene& scene = imported.scene;
  const std::vector<bool> with_curves = prototypes_with_curves(scene);
  const auto say = [&](const Origin& origin, RecordKind kind, const char* what) {
    const SourceLocation place = location(scene, origin);
    imported.diagnostics.push_back({Fidelity::approximated, what, place, place, kind});
  };
  const auto look_at = [&](const std::vector<Shape>& shapes, const std::vector<Instance>& instances) {
    for (const Shape& shape : shapes) {
      if (!is_of_curves(scene, shape) || (!shape.area_light && is_similarity(shape.object_to_world)))
        continue;
      const bool twice =
          shape.opacity != FloatParameter{1.0f} && (shape.area_light || !std::get_if<float>(&shape.opacity));
      say(shape.origin, RecordKind::shape,
          twice ? "curves that shine, or that no similarity places, become tubes of triangles, in both of "
                  "whose "
                  "walls their opacity counts"
                : "curves that shine, or that no similarity places, become tubes of triangles");
    }
    for (const Instance& instance : instances)
      if (with_curves[instance.prototype.value] && !is_similarity(instance.prototype_to_world))
        say(instance.origin, RecordKind::instance,
            instance.motion ? "curves that move and are stretched have radii of its root mean square"
                            : "curves that are stretched become tubes of triangles");
  };
  look_at(scene.shapes, scene.instances);
  for (const Prototype& prototype : scene.prototypes) look_at(prototype.shapes, prototype.instances);
}

}  // namespace

ImportedScene read_scene_file(const std::filesystem::path& file, MeshMemory memory,
                              std::function<void(double)> progress, const ImportOptions& options) {
  if (!options.sky.empty()) parse_sky(options.sky);  // what is wrong with it is said at once
  ImportedScene imported;
  try {
    imported = read_scene(file, std::move(memory), std::move(progress), options);
  } catch (const Error& error) {
    throw without_foreign_text(error, file);
  }
  require_shallow(imported.scene);
  return imported;
}

void complete_scene(ImportedScene& imported, const ImportOptions& options) {
  drop_coincident_lamps(imported);
  give_glazing(imported, options.glazing);
  if (!options.sky.empty()) replace_sky(imported, parse_sky(options.sky));
  report_tubes(imported);
}

ImportedScene import_scene(const std::filesystem::path& file, MeshMemory memory,
                           std::function<void(double)> progress, const ImportOptions& options) {
  ImportedScene imported = read_scene_file(file, std::move(memory), std::move(progress), options);
  complete_scene(imported, options);
  return imported;
}

}  // namespace vitrail
