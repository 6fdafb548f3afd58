// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "importers/writing/side_files.h"
#include "scene/records/scene.h"

namespace vitrail {

// It names the meshes that a written scene refers to: OUT.pbrt has them in OUT-meshes/000000.ply, 000001.ply
// … or under names beside these that are free. Each is written once, when it is first asked for.
class MeshFiles {
 public:
  MeshFiles(const Scene& scene, const std::filesystem::path& scene_file);

  // Returns the file's path relative to the scene's; a quadric's has its triangles. Throws MachineError.
  const std::string& name(Id<TriangleMesh> mesh);
  bool has_name(Id<TriangleMesh> mesh) const { return !names_.at(mesh.value).empty(); }
  // Returns the same, and writes `instead` where the format needs another form of the mesh.
  const std::string& name(Id<TriangleMesh> mesh, const TriangleMesh& instead);

 private:
  const Scene& scene_;
  std::filesystem::path directory_;  // of the scene
  SideFiles files_;
  std::vector<std::string> names_;
};

// Returns `file` (absolute) as a scene in `directory` refers to it: relative where it is below or beside,
// with / on every system.
std::string relative_name(const std::string& file, const std::filesystem::path& directory);

}  // namespace vitrail
