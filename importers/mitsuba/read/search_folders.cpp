// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/search_folders.h"

#include <algorithm>

namespace vitrail::mitsuba {

std::filesystem::path SearchFolders::resolve(const std::string& name) const {
  std::error_code ignored;
  if (name.find('\\') != std::string::npos && !std::filesystem::exists(found(name), ignored)) {
    std::string with_slashes = name;
    std::ranges::replace(with_slashes, '\\', '/');
    return found(with_slashes);
  }
  return found(name);
}

std::filesystem::path SearchFolders::found(const std::string& name) const {
  std::error_code ignored;
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder)
    if (std::filesystem::exists(*folder / name, ignored)) return (*folder / name).lexically_normal();
  // Collections of scenes keep what they share in a folder "common" above them.
  std::filesystem::path above = folders_.front();
  for (int levels = 0; levels < 4 && above.has_relative_path(); ++levels, above = above.parent_path())
    if (std::filesystem::exists(above / "common" / name, ignored))
      return (above / "common" / name).lexically_normal();
  return (folders_.front() / name).lexically_normal();
}

}  // namespace vitrail::mitsuba
