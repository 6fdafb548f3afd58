// SPDX-License-Identifier: Apache-2.0
// A scene names files, which are sought in these folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::mitsuba {

class SearchFolders {
 public:
  explicit SearchFolders(std::filesystem::path folder_of_scene) : folders_{std::move(folder_of_scene)} {}

  void add(std::filesystem::path folder) { folders_.push_back(std::move(folder)); }  // searched first

  // Returns the path of the file. Where there is no such file, it is where it would be beside the scene. A
  // path of Windows counts with slashes where there is no file of its name.
  std::filesystem::path resolve(const std::string& name) const;

 private:
  std::filesystem::path found(const std::string& name) const;

  std::vector<std::filesystem::path> folders_;  // that of the scene, then those added
};

}  // namespace vitrail::mitsuba
