// SPDX-License-Identifier: Apache-2.0
#include "farm/output_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "scene/diagnostics.h"

namespace vitrail {

namespace {

// The holder of a lock removes its file: what was opened before that is no lock any more.
bool is_still_named(int descriptor, const std::filesystem::path& file) {
  struct stat opened = {}, named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::string holder(int descriptor) {
  std::array<char, 256> text{};
  const ssize_t bytes = ::pread(descriptor, text.data(), text.size(), 0);
  return bytes > 0 ? std::string(text.data(), static_cast<std::size_t>(bytes)) : "another process";
}

}  // namespace

OutputLock::OutputLock(const std::filesystem::path& output) : file_(output) {
  file_ += ".lock";
  while (descriptor_ < 0) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
      throw MachineError(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
    const bool free = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    if (free && is_still_named(descriptor_, file_)) break;
    const std::string who = holder(descriptor_);
    ::close(std::exchange(descriptor_, -1));
    if (!free)
      throw MachineError(
          fmt::format("{} is being written by another render ({}): wait for it, or give another "
                      "output",
                      output.string(), who));
  }
  std::array<char, 128> host{};
  ::gethostname(host.data(), host.size() - 1);
  const std::string who = fmt::format("process {} on {}", ::getpid(), host.data());
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, who.data(), who.size(), 0) < 0) {
    // A full disk: the lock holds all the same.
  }
}

OutputLock::~OutputLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace vitrail
