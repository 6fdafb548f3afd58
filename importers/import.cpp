// SPDX-License-Identifier: Apache-2.0
#include "importers/import.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "importers/mitsuba/read/mitsuba.h"
#include "importers/obj/read/obj.h"
#include "importers/pbrt/read/pbrt.h"
#include "importers/ply/read/ply.h"
#include "importers/povray/read/povray.h"
#include "importers/reading/coincident_lamps.h"
#include "importers/reading/default_view.h"
#include "importers/reading/foreign_text.h"
#include "importers/reading/given_sky.h"
#include "importers/reading/missing_files.h"
#include "scene/records/curve_uses.h"
#include "scene/records/nesting_limits.h"
#include "scene/shapes/curve.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// ".pbrt" of "a.pbrt" and of "a.PBRT.gz".
std::string format_of(std::filesystem::path file) {
  const auto lower = [](std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  };
  const std::string extension = lower(file.extension().string());
  return extension == ".gz" ? lower(file.stem().extension().string()) : extension;
}

ImportedScene mesh_alone(const std::filesystem::path& file, MeshMemory& memory) {
  ImportedScene imported;
  Scene& scene = imported.scene;
  TriangleMesh mesh = read_ply(file, &imported.diagnostics, PlyAttributes::colors);
  scene.materials.push_back({DiffuseMaterial{}});
  if (!mesh.attributes.empty()) {
    scene.textures.push_back({MeshAttributeTexture{mesh.attributes.front().name}});
    scene.materials.front().model = DiffuseMaterial{Id<Texture>{0}};
  }
  scene.meshes.push_back(
      memory.keep(std::move(mesh), [file] { return read_ply(file, nullptr, PlyAttributes::colors); }));
  imported.scene.shapes.push_back({});
  return imported;
}

}  // namespace

namespace {

ImportedScene read_scene(const std::filesystem::path& file, MeshMemory memory,
                         std::function<void(double)> progress, const ImportOptions& options) {
  const std::string format = format_of(file);
  if (!options.definitions.empty() && format != ".xml")
    throw UsageError(file.string() + ": only scenes of Mitsuba have parameters that -D could set");
  if (options.camera != 0 && format != ".xml")
    throw UsageError(file.string() + ": only scenes of Mitsuba have more than one camera");
  ImportedScene imported;
  if (format == ".pov") return read_povray(file, std::move(memory), options);
  if (format == ".pbrt" || format == ".xml") {
    imported = format == ".xml" ? read_mitsuba(file, std::move(memory), options)
                                : read_pbrt(file, std::move(memory), std::move(progress), options);
    if (options.replace_missing) replace_missing_images(imported);
    return imported;
  }
  if (format == ".obj") {
    imported = read_obj(file);
    for (TriangleMesh& mesh : imported.scene.meshes) mesh = memory.keep(std::move(mesh), {});
  } else if (format == ".ply") {
    imported = mesh_alone(file, memory);
  } else {
    throw Error("unknown format: the name has to end in .pbrt, .xml, .pov, .obj or .ply; .gz may follow",
                {file.string()});
  }
  add_default_view(imported, file);
  if (options.replace_missing) replace_missing_images(imported);
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

ImportedScene import_scene(const std::filesystem::path& file, MeshMemory memory,
                           std::function<void(double)> progress, const ImportOptions& options) {
  const std::optional<GivenSky> sky =
      options.sky.empty() ? std::nullopt : std::optional(parse_sky(options.sky));
  ImportedScene imported;
  try {
    imported = read_scene(file, std::move(memory), std::move(progress), options);
  } catch (const Error& error) {
    throw without_foreign_text(error, file);
  }
  require_shallow(imported.scene);
  drop_coincident_lamps(imported);
  if (sky) replace_sky(imported, *sky);
  report_tubes(imported);
  return imported;
}

}  // namespace vitrail
