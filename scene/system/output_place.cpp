// SPDX-License-Identifier: Apache-2.0
#include "scene/system/output_place.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace fs = std::filesystem;

void require_folder_of(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw MachineError(
        fmt::format("cannot write {}: {}: {}", file.string(), folder.string(), std::strerror(errno)));
}

void require_place(const fs::path& file) {
  require_folder_of(file);
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw MachineError(fmt::format("cannot write {}: it is a folder", file.string()));
  if (is_input(file))
    throw UsageError(
        fmt::format("{} is read by this command: give what it writes another name", file.string()));
}

void require_room(const fs::path& file, std::uint64_t bytes) {
  std::error_code unknown;
  const fs::space_info space = fs::space(fs::absolute(file).parent_path(), unknown);
  if (unknown || space.available >= bytes) return;
  throw MachineError(fmt::format("No space left for {}: it takes {} MB, and its disk has {} MB free",
                                 file.string(), bytes / 1'000'000 + 1, space.available / 1'000'000));
}

}  // namespace vitrail
