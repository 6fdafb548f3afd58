// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <unordered_set>

namespace vitrail {

// It gives names to files that are written beside a scene. A file of such a name that the scene's file spoke
// of before is replaced; any other, and one that was read, belongs to somebody: the name gets a number, as in
// OUT-meshes/000000-2.ply.
class SideFiles {
 public:
  explicit SideFiles(const std::filesystem::path& scene_file);

  // Returns "OUT-KIND/000003.EXTENSION", relative to the scene's folder; creates OUT-KIND. Throws
  // MachineError.
  std::string name(const std::string& kind, std::size_t number, const std::string& extension) const;
  // Returns "OUT.EXTENSION".
  std::string name(const std::string& extension) const;

 private:
  std::string free_name(const std::string& name, const std::string& extension) const;

  std::filesystem::path directory_;
  std::string stem_;
  std::unordered_set<std::string> own_;
};

}  // namespace vitrail
