// SPDX-License-Identifier: Apache-2.0
#include "bundle/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

void write_file(const std::filesystem::path& file, std::span<const std::span<const std::byte>> parts) {
  write_file(file, [&](const ByteSink& write) { std::ranges::for_each(parts, write); });
}

void write_file(const std::filesystem::path& file, const std::function<void(const ByteSink&)>& content) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0)
    throw MachineError(fmt::format("cannot create {}: {}", file.string(), std::strerror(errno)));
  bool written = true;
  int reason = 0;
  content([&](std::span<const std::byte> bytes) {
    if (!written || write_all(descriptor, bytes)) return;
    written = false;
    reason = errno;
  });
  if (::close(descriptor) != 0 && written) {
    written = false;
    reason = errno;
  }
  if (written) return;
  ::unlink(file.c_str());
  throw MachineError(fmt::format("cannot write {}: {}", file.string(), std::strerror(reason)));
}

}  // namespace vitrail
