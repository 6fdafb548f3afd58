// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply_scene.h"

#include <fmt/format.h>

#include "importers/bytes/text_cursor.h"
#include "importers/ply/read/ply.h"
#include "importers/reading/named_file.h"

namespace vitrail {

namespace {

// The image of a file that names some, where the mesh has places in it.
std::optional<TextureModel> image_of(const std::filesystem::path& file, const TriangleMesh& mesh,
                                     Diagnostics& diagnostics) {
  const std::vector<std::string> names = texture_files_of_ply(file);
  if (names.empty()) return {};
  const auto lose = [&](std::string message) {
    diagnostics.push_back({Fidelity::dropped, std::move(message), {file.string()}});
  };
  const std::string shown = printable(names.front());
  if (names.size() > 1)
    lose(fmt::format("TextureFile: only the first of {} images counts, '{}'", names.size(), shown));
  ImageTexture image;
  image.filename = named_file(names.front(), std::filesystem::absolute(file).parent_path());
  if (!mesh.uvs.empty()) return image;
  lose(fmt::format("TextureFile '{}': the mesh has no (u,v)", shown));
  return {};
}

}  // namespace

ImportedScene read_ply_scene(const std::filesystem::path& file, MeshMemory memory) {
  ImportedScene imported;
  Scene& scene = imported.scene;
  scene.files = {file.string()};
  TriangleMesh mesh = read_ply(file, &imported.diagnostics, PlyAttributes::look);
  scene.materials.push_back({DiffuseMaterial{}});
  std::optional<TextureModel> look = image_of(file, mesh, imported.diagnostics);
  if (look && !mesh.attributes.empty()) {
    imported.diagnostics.push_back({Fidelity::dropped,
                                    "colours of vertices or faces: the image of TextureFile counts",
                                    {file.string()}});
  } else if (!mesh.attributes.empty()) {
    look = MeshAttributeTexture{mesh.attributes.front().name};
  }
  if (look) {
    scene.textures.push_back({std::move(*look)});
    scene.materials.front().model = DiffuseMaterial{Id<Texture>{0}};
  }
  scene.meshes.push_back(
      memory.keep(std::move(mesh), [file] { return read_ply(file, nullptr, PlyAttributes::look); }));
  scene.shapes.push_back({});
  return imported;
}

SkimmedScene skim_ply_scene(const std::filesystem::path& file) {
  const PlyCounts counts = count_ply(file);
  SkimmedScene skimmed =
      skimmed_model({&counts.triangles, 1}, counts.bytes + counts.color_bytes, counts.has_normals);
  if (counts.color_bytes > 0) skimmed.scene.textures.push_back({MeshAttributeTexture{}});
  return skimmed;
}

}  // namespace vitrail
