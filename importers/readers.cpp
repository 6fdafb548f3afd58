// SPDX-License-Identifier: Apache-2.0
#include "importers/readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "glazing/foreign_file.h"
#include "importers/assimp/read/assimp.h"
#include "importers/gltf/read/gltf.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/obj/read/count_obj.h"
#include "importers/obj/read/obj.h"
#include "importers/pbrt/read/pbrt.h"
#include "importers/ply/read/ply_scene.h"
#include "importers/povray/read/povray.h"
#include "importers/stl/read/stl.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

ImportedScene read_obj_scene(ReadRequest request) {
  ImportedScene imported = read_obj(request.file);
  for (TriangleMesh& mesh : imported.scene.meshes) mesh = request.memory.keep(std::move(mesh), {});
  return imported;
}

// As many vertices as the longest list has, shared out by triangles; the lists and corners are held beside
// them.
SkimmedScene skim_obj(const ReadRequest& request) {
  const ObjCounts counts = count_obj(request.file);
  const std::uint64_t lists = 12 * counts.positions + 8 * counts.uvs + 12 * counts.normals;
  const std::uint64_t a_vertex = 12u + (counts.uvs > 0 ? 8u : 0u) + (counts.normals > 0 ? 12u : 0u);
  SkimmedScene skimmed = skimmed_model(
      counts.parts,
      a_vertex * std::max({counts.positions, counts.uvs, counts.normals}) + 12 * counts.triangles,
      counts.normals > 0);
  skimmed.statement_bytes += lists + 4 * counts.corners;
  return skimmed;
}

ImportedScene read_stl_scene(ReadRequest request) {
  const std::filesystem::path& file = request.file;
  ImportedScene imported;
  TriangleMesh mesh = read_stl(file);
  DiffuseMaterial material;
  if (!mesh.attributes.empty()) {
    imported.scene.textures.push_back({MeshAttributeTexture{mesh.attributes.front().name}});
    material.reflectance = Id<Texture>{0};
  }
  imported.scene.materials.push_back({material});
  imported.scene.meshes.push_back(request.memory.keep(std::move(mesh), [file] { return read_stl(file); }));
  imported.scene.shapes.push_back({});
  return imported;
}

bool is_ply(std::string_view bytes) {
  constexpr std::string_view mark = "\xef\xbb\xbf";  // of UTF-8
  if (bytes.starts_with(mark)) bytes.remove_prefix(mark.size());
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}
bool is_mitsuba(std::string_view bytes) {
  return bytes.starts_with("<?xml") || bytes.starts_with("<scene") || bytes.starts_with("<!--");
}

std::string lower(std::string word) {
  std::ranges::transform(word, word.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

std::string first_bytes(const std::filesystem::path& file) {
  std::string bytes(256, '\0');
  std::ifstream in = open_input(file);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> rows{
      {.name = "pbrt",
       .suffixes = {".pbrt"},
       .gzipped = true,
       .sniff = nullptr,
       .read = [](ReadRequest r) { return read_pbrt(r.file, std::move(r.memory), r.progress, r.options); },
       .adds_view = true,
       .has_definitions = false,
       .has_many_cameras = false,
       .skim = [](const ReadRequest& r) { return skim_pbrt(r.file, r.progress, r.options); }},
      {.name = "Mitsuba",
       .suffixes = {".xml"},
       .gzipped = true,
       .sniff = is_mitsuba,
       .read = [](ReadRequest r) { return read_mitsuba(r.file, std::move(r.memory), r.options); },
       .adds_view = true,
       .has_definitions = true,
       .has_many_cameras = true},
      {.name = "glTF",
       .suffixes = {".gltf", ".glb"},
       .gzipped = false,
       .sniff = is_gltf,
       .read = [](ReadRequest r) { return read_gltf(r.file, std::move(r.memory), r.options); },
       .adds_view = true,
       .has_definitions = false,
       .has_many_cameras = true},
      {.name = "POV-Ray",
       .suffixes = {".pov"},
       .gzipped = false,
       .sniff = nullptr,
       .read = [](ReadRequest r) { return read_povray(r.file, std::move(r.memory), r.options); },
       .adds_view = true,
       .has_definitions = true,
       .has_many_cameras = false},
      {.name = "Wavefront OBJ",
       .suffixes = {".obj"},
       .gzipped = true,
       .sniff = nullptr,
       .read = read_obj_scene,
       .adds_view = false,
       .has_definitions = false,
       .has_many_cameras = false,
       .goes_on_without_images = true,
       .skim = skim_obj},
      {.name = "PLY",
       .suffixes = {".ply"},
       .gzipped = true,
       .sniff = is_ply,
       .read = [](ReadRequest r) { return read_ply_scene(r.file, std::move(r.memory)); },
       .adds_view = false,
       .has_definitions = false,
       .has_many_cameras = false,
       .goes_on_without_images = true,
       .skim = [](const ReadRequest& r) { return skim_ply_scene(r.file); }},
      {.name = "STL",
       .suffixes = {".stl"},
       .gzipped = true,
       .sniff = nullptr,
       .read = read_stl_scene,
       .adds_view = false,
       .has_definitions = false,
       .has_many_cameras = false},
      {.name = "FBX, COLLADA and 3DS",
       .suffixes = {".fbx", ".dae", ".3ds"},
       .gzipped = false,
       .sniff = nullptr,
       .read = [](ReadRequest r) { return read_assimp(r.file, std::move(r.memory), r.options); },
       .adds_view = true,
       .has_definitions = false,
       .has_many_cameras = true,
       .goes_on_without_images = true},
  };
  return rows;
}

const Reader& reader_of(const std::filesystem::path& file) {
  const std::string last = lower(file.extension().string());
  const bool gzipped = last == ".gz";
  const std::string suffix = gzipped ? lower(file.stem().extension().string()) : last;
  for (const Reader& reader : readers())
    if ((!gzipped || reader.gzipped) && std::ranges::count(reader.suffixes, suffix) > 0) return reader;
  const std::string bytes = first_bytes(file);
  for (const Reader& reader : readers())
    if (reader.sniff && reader.sniff(bytes)) return reader;
  const std::string kind = foreign_kind(bytes, file.string());
  std::string known, zipped;
  for (const Reader& reader : readers())
    for (const std::string_view each : reader.suffixes) {
      fmt::format_to(std::back_inserter(known), "{}{}", known.empty() ? "" : ", ", each);
      if (reader.gzipped)
        fmt::format_to(std::back_inserter(zipped), "{}{}", zipped.empty() ? "" : ", ", each);
    }
  throw Error(fmt::format("{}: the name has to end in one of {}; .gz may follow {}",
                          kind.empty() ? "unknown format" : fmt::format("this is {} and no scene", kind),
                          known, zipped),
              {file.string()});
}

}  // namespace vitrail
