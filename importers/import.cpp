// SPDX-License-Identifier: Apache-2.0
#include "importers/import.h"

#include <algorithm>
#include <cctype>

#include "importers/default_view.h"
#include "importers/given_sky.h"
#include "importers/missing_files.h"
#include "importers/mitsuba/mitsuba.h"
#include "importers/obj/obj.h"
#include "importers/pbrt/pbrt.h"
#include "importers/ply/ply.h"
#include "scene/diagnostics.h"

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
  imported.scene.meshes.push_back(
      memory.keep(read_ply(file, &imported.diagnostics), [file] { return read_ply(file); }));
  imported.scene.materials.push_back({DiffuseMaterial{}});
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
  if (format == ".pbrt" || format == ".xml") {
    imported = format == ".xml"
                   ? read_mitsuba(file, std::move(memory), options)
                   : read_pbrt(file, std::move(memory), std::move(progress), options.replace_missing);
    if (options.replace_missing) replace_missing_images(imported);
    return imported;
  }
  if (format == ".obj") {
    imported = read_obj(file);
    for (TriangleMesh& mesh : imported.scene.meshes) mesh = memory.keep(std::move(mesh), {});
  } else if (format == ".ply") {
    imported = mesh_alone(file, memory);
  } else {
    throw Error("unknown format: the name has to end in .pbrt, .xml, .obj or .ply; .gz may follow",
                {file.string()});
  }
  add_default_view(imported, file);
  if (options.replace_missing) replace_missing_images(imported);
  return imported;
}

}  // namespace

ImportedScene import_scene(const std::filesystem::path& file, MeshMemory memory,
                           std::function<void(double)> progress, const ImportOptions& options) {
  if (options.sky.empty()) return read_scene(file, std::move(memory), std::move(progress), options);
  const GivenSky sky = parse_sky(options.sky);
  ImportedScene imported = read_scene(file, std::move(memory), std::move(progress), options);
  replace_sky(imported, sky);
  return imported;
}

}  // namespace vitrail
