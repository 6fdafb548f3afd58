// SPDX-License-Identifier: Apache-2.0
#include "scene/system/temporary_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

[[noreturn]] void fail(const char* verb, const char* what) {
  throw MachineError(fmt::format("cannot {} the {} kept in the folder for temporary files: {}", verb, what,
                                 std::strerror(errno)));
}

// Until all is there: `transfer(done)` moves some of what follows.
template <class Transfer>
void transfer_all(std::size_t bytes, const char* verb, const char* what, const Transfer& transfer) {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t n = transfer(done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(verb, what);
    done += static_cast<std::size_t>(n);
  }
}

}  // namespace

std::FILE* open_temporary(const char* what) {
  std::FILE* file = std::tmpfile();
  if (!file) fail("write", what);
  return file;
}

void write_at(std::FILE* file, std::uint64_t offset, std::span<const std::byte> bytes, const char* what) {
  transfer_all(bytes.size(), "write", what, [&](std::size_t done) {
    return ::pwrite(::fileno(file), bytes.data() + done, bytes.size() - done,
                    static_cast<off_t>(offset + done));
  });
}

void read_at(std::FILE* file, std::uint64_t offset, std::span<std::byte> bytes, const char* what) {
  transfer_all(bytes.size(), "read", what, [&](std::size_t done) {
    return ::pread(::fileno(file), bytes.data() + done, bytes.size() - done,
                   static_cast<off_t>(offset + done));
  });
}

}  // namespace vitrail
