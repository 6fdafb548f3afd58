// SPDX-License-Identifier: Apache-2.0
#include "scene/system/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

std::atomic<bool> parts_on_their_way{false};  // to the disk

[[noreturn]] void fail(const char* what, const std::filesystem::path& file) {
  throw MachineError(fmt::format("cannot {} {}: {}", what, file.string(), std::strerror(errno)));
}

}  // namespace

std::filesystem::path behind_links(std::filesystem::path file) {
  constexpr int most_links = 40;  // as Linux follows
  const std::filesystem::path named = file;
  std::error_code none;
  for (int links = 0; std::filesystem::is_symlink(file, none); ++links) {
    if (links == most_links)
      throw MachineError(fmt::format("cannot write {}: {}", named.string(), std::strerror(ELOOP)));
    file = file.parent_path() / std::filesystem::read_symlink(file);
  }
  return file;
}

AtomicFile::AtomicFile(std::filesystem::path target) : target_(behind_links(std::move(target))) {
  if (is_input(target_))
    throw UsageError(
        fmt::format("{} is an input of this command, and would be overwritten", target_.string()));
  temporary_ = target_;
  temporary_ += fmt::format(".tmp{}", ::getpid());
  const Underway underway("creating", temporary_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("create", temporary_);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  const Underway underway("writing", temporary_);
  size_ += bytes.size();
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", temporary_);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void AtomicFile::write_at(std::uint64_t place, std::span<const std::byte> bytes) {
  const Underway underway("writing", temporary_);
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", temporary_);
    place += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void AtomicFile::sync() const {
  const Underway underway("syncing", temporary_);
  if ((parts_on_their_way.exchange(false) ? ::syncfs(descriptor_) : ::fsync(descriptor_)) != 0)
    fail("sync", temporary_);
}

void AtomicFile::rename_to_target() {
  const Underway underway("writing", target_);
  if (::close(std::exchange(descriptor_, -1)) == 0 && std::rename(temporary_.c_str(), target_.c_str()) == 0)
    return;
  const int reason = errno;
  ::unlink(temporary_.c_str());
  errno = reason;
  fail("write", target_);
}

void AtomicFile::commit() {
  sync();
  rename_to_target();
  sync_to_disk(target_.has_parent_path() ? target_.parent_path() : ".");
}

void AtomicFile::commit_part() {
  rename_to_target();
  parts_on_their_way = true;
}

void remove_temporaries(const std::filesystem::path& named) {
  const std::filesystem::path target = behind_links(named);
  const std::string prefix = target.filename().string() + ".tmp";
  std::error_code ignored;
  const auto folder = std::filesystem::absolute(target).parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.find_first_not_of("0123456789", prefix.size()) == std::string::npos)
      std::filesystem::remove(entry.path(), ignored);
  }
}

void sync_to_disk(const std::filesystem::path& path) {
  const Underway underway("syncing", path);
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("open", path);
  const bool synced = ::fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: there is nothing to sync there
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  if (!synced) fail("sync", path);
}

}  // namespace vitrail
