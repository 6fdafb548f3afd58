// SPDX-License-Identifier: Apache-2.0
#include "scene/system/input_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "scene/system/diagnostics.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

using Identity = std::pair<dev_t, ino_t>;

struct Inputs {
  std::atomic<bool> protect = false;
  std::mutex mutex;
  std::set<Identity> files;
  std::filesystem::path folder;  // canonical; "" where all files may be read
};

Inputs& inputs() {
  static Inputs only;
  return only;
}

std::optional<Identity> identity_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return Identity{status.st_dev, status.st_ino};
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

}  // namespace

// A pipe would be waited for, but for O_NONBLOCK, which changes nothing of a regular file.
RegularFile::RegularFile(const std::filesystem::path& file) {
  const Underway underway("opening", file);
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0 || ::fstat(descriptor_, &status_) != 0) {
    reason_ = errno;
    return;
  }
  if (S_ISREG(status_.st_mode) && !is_lfs_pointer()) return;
  ::close(descriptor_);
  throw Error(S_ISREG(status_.st_mode)
                  ? "this is a pointer of Git LFS, not the file: 'git lfs pull' in its repository brings that"
                  : fmt::format("this is {}, not a file", kind_of(status_.st_mode)),
              {file.string()});
}

bool RegularFile::is_lfs_pointer() const {
  constexpr std::string_view begin = "version https://git-lfs.github.com/spec/";
  constexpr std::uint64_t longest = 1024;  // bytes, by its specification
  std::array<char, begin.size()> text{};
  return size() >= text.size() && size() < longest && read(std::as_writable_bytes(std::span(text)), 0) &&
         std::ranges::equal(text, begin);
}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool RegularFile::read(std::span<std::byte> to, std::uint64_t offset) const {
  while (!to.empty()) {
    const ssize_t n = ::pread(descriptor_, to.data(), to.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    to = to.subspan(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
  return true;
}

std::ifstream open_regular(const std::filesystem::path& file) {
  const RegularFile regular(file);
  return std::ifstream(file, std::ios::binary);
}

void confine_inputs(const std::filesystem::path& folder) {
  std::error_code missing;
  inputs().folder = std::filesystem::canonical(folder, missing);
  if (missing || !std::filesystem::is_directory(inputs().folder, missing))
    throw UsageError(fmt::format("--root {}: there is no such folder", folder.string()));
}

void require_confined(const std::filesystem::path& file) {
  const std::filesystem::path& folder = inputs().folder;
  if (folder.empty()) return;
  std::error_code unknown;
  const std::filesystem::path there = std::filesystem::weakly_canonical(file, unknown);
  if (unknown || std::ranges::mismatch(folder, there).in1 != folder.end())
    throw Error(
        fmt::format("this file is outside of {}, the only folder that --root allows", folder.string()),
        {file.string()});
}

void check_input(const std::filesystem::path& file) {
  require_confined(file);
  const RegularFile regular(file);
  note_input(file);
}

std::ifstream open_input(const std::filesystem::path& file) {
  check_input(file);
  return std::ifstream(file, std::ios::binary);
}

void protect_inputs() { inputs().protect = true; }

void note_input(const std::filesystem::path& file) {
  if (!inputs().protect) return;
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().files.insert(*identity);
}

bool is_input(const std::filesystem::path& file) {
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return false;
  const std::lock_guard lock(inputs().mutex);
  return inputs().files.contains(*identity);
}

}  // namespace vitrail
