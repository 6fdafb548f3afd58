// SPDX-License-Identifier: Apache-2.0
#include "scene/system/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace vitrail {

namespace {

// A rank's standard error is a pipe to mpirun, which copies it to its own: what that is. Empty: no terminal.
std::string terminal_of_mpirun() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return {};
  std::error_code elsewhere;
  const std::string behind =
      std::filesystem::read_symlink(fmt::format("/proc/{}/fd/2", ::getppid()), elsewhere).string();
  return behind.starts_with("/dev/pts/") || behind.starts_with("/dev/tty") ? behind : "";
}

// 0: it does not say.
int columns_of(int descriptor) {
  winsize size{};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

bool on_terminal() { return ::isatty(STDERR_FILENO) != 0 || !terminal_of_mpirun().empty(); }

int terminal_columns() {
  int columns = columns_of(STDERR_FILENO);
  if (const std::string name = terminal_of_mpirun(); columns == 0 && !name.empty()) {
    const int terminal = ::open(name.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC);
    columns = columns_of(terminal);
    ::close(terminal);
  }
  if (columns > 0) return columns;
  const char* named = std::getenv("COLUMNS");
  const int given = named ? std::atoi(named) : 0;
  return given > 0 ? given : 80;
}

bool has_color() {
  const char *refused = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  return on_terminal() && (!refused || !*refused) && (!terminal || std::string(terminal) != "dumb");
}

}  // namespace vitrail
