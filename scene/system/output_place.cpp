// SPDX-License-Identifier: Apache-2.0
#include "scene/system/output_place.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace fs = std::filesystem;

void require_folder_of(const fs::path& file) {
  const fs::path folder = fs::absolute(behind_links(file)).parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return;
  const int reason = errno;
  throw MachineError(fmt::format("cannot write {}: {}: {}{}", file.string(), folder.string(),
                                 std::strerror(reason),
                                 reason == ENOENT ? "; make this folder first (mkdir -p)" : ""));
}

void require_short_name(const fs::path& named) {
  // A file is first written under a name that ends with the process's number (atomic_file.h).
  constexpr const char* longest_ending = ".tmp4194304";
  const fs::path file = behind_links(named);
  const std::string name = file.filename().string() + longest_ending;
  const long most = ::pathconf(fs::absolute(file).parent_path().c_str(), _PC_NAME_MAX);
  if (most < 0 || name.size() <= static_cast<std::size_t>(most)) return;
  throw UsageError(
      fmt::format("cannot write {}: its name is {} characters too long, as it is first written as {}",
                  file.string(), name.size() - static_cast<std::size_t>(most), name));
}

void require_place(const fs::path& file) {
  require_folder_of(file);
  require_short_name(file);
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw MachineError(fmt::format("cannot write {}: it is a folder", file.string()));
  if (is_input(file))
    throw UsageError(
        fmt::format("{} is an input of this command: give the output another name", file.string()));
}

void require_room(const fs::path& file, std::uint64_t bytes) {
  std::error_code unknown;
  const fs::space_info space = fs::space(fs::absolute(behind_links(file)).parent_path(), unknown);
  if (unknown || space.available >= bytes) return;
  throw MachineError(fmt::format("No space left for {}: it takes {} MB, and its disk has {} MB free",
                                 file.string(), bytes / 1'000'000 + 1, space.available / 1'000'000));
}

}  // namespace vitrail
