// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/mesh_files.h"

#include "importers/writing/write_ply.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

MeshFiles::MeshFiles(const Scene& scene, const std::filesystem::path& scene_file)
    : scene_(scene), directory_(scene_file.parent_path()), files_(scene_file), names_(scene.meshes.size()) {}

const std::string& MeshFiles::name(Id<TriangleMesh> mesh) {
  if (has_name(mesh)) return names_[mesh.value];
  TriangleMesh storage;
  return name(mesh, loaded(scene_.meshes[mesh.value], storage));
}

const std::string& MeshFiles::name(Id<TriangleMesh> mesh, const TriangleMesh& instead) {
  std::string& name = names_.at(mesh.value);
  if (!name.empty()) return name;
  name = files_.name("meshes", mesh.value, "ply");
  write_ply_part(instead, directory_ / name);
  return name;
}

std::string relative_name(const std::string& file, const std::filesystem::path& directory) {
  std::error_code error;
  const std::filesystem::path base = std::filesystem::weakly_canonical(
      directory.empty() ? std::filesystem::current_path() : std::filesystem::absolute(directory), error);
  if (error) return file;
  const std::filesystem::path relative =
      std::filesystem::weakly_canonical(file, error).lexically_relative(base);
  return error || relative.empty() ? file : relative.generic_string();
}

}  // namespace vitrail
