// SPDX-License-Identifier: Apache-2.0
#include "cli/common/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace vitrail {

bool on_terminal() {
  if (::isatty(STDERR_FILENO)) return true;
  // A rank's standard error is a pipe to mpirun, which copies it to its own.
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return false;
  std::error_code elsewhere;
  const std::string behind =
      std::filesystem::read_symlink(fmt::format("/proc/{}/fd/2", ::getppid()), elsewhere).string();
  return behind.starts_with("/dev/pts/") || behind.starts_with("/dev/tty");
}

}  // namespace vitrail
