// SPDX-License-Identifier: Apache-2.0
#include "partitioner/writing/bundle_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

fs::path beside(const fs::path& target, const char* what) {
  fs::path p = target;
  p += fmt::format(".{}{}", what, ::getpid());
  return p;
}

void check_target(const fs::path& target) {
  if (fs::exists(fs::symlink_status(target)) && !fs::exists(target / "manifest.json"))
    throw UsageError(
        fmt::format("{} exists and is not a bundle; choose another name or remove it", target.string()));
}

// −1 where another process has it.
int lock_directory(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : "."; }

// Of processes that were killed.
void remove_leftovers(const fs::path& target) {
  const fs::path folder = folder_of(target);
  if (!fs::exists(folder)) return;
  const std::string prefix = fmt::format("{}.tmp", target.filename().string());
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || name.size() == prefix.size() ||
        !std::all_of(name.begin() + static_cast<std::ptrdiff_t>(prefix.size()), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; }))
      continue;
    const int lock = lock_directory(entry.path());
    if (lock < 0) continue;
    fs::remove_all(entry.path());
    ::close(lock);
  }
}

[[noreturn]] void fail(const fs::filesystem_error& e) {
  throw MachineError(fmt::format("cannot write {}: {}", e.path1().string(), e.code().message()));
}

}  // namespace

BundleDirectory::BundleDirectory(fs::path target, bool durable)
    : target_(std::move(target)), durable_(durable) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // a slash at the end
  if (target_.empty()) throw UsageError("the bundle has no name");
  target_ = behind_links(target_);
  temporary_ = beside(target_, "tmp");
  try {
    check_target(target_);
    remove_leftovers(target_);
    fs::create_directories(temporary_ / "domains");
    lock_ = lock_directory(temporary_);
  } catch (const fs::filesystem_error& e) {
    fail(e);
  }
}

BundleDirectory::~BundleDirectory() {
  const GrantedMemory in_any_case;
  std::error_code ignored;
  if (!committed_) fs::remove_all(temporary_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

// Returns where the bundle is that had the name before; empty where there was none.
fs::path BundleDirectory::give_name() const {
  if (!fs::exists(target_)) {
    fs::rename(temporary_, target_);
    return {};
  }
  // Some bundle has the name at every moment, and what is killed now leaves the old one to remove_leftovers.
  if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0)
    return temporary_;
  // A file system that cannot exchange.
  fs::path old = beside(target_, "old");
  fs::rename(target_, old);
  try {
    fs::rename(temporary_, target_);
  } catch (...) {
    fs::rename(old, target_);
    throw;
  }
  return old;
}

void BundleDirectory::commit() {
  try {
    check_target(target_);
    // Of the whole file system: for 4096 files a sixth of the time of starting to write them all back and
    // syncing one after the other. What failed since the directory was opened is an error too.
    if (durable_ && ::syncfs(lock_) != 0)
      throw MachineError(fmt::format("cannot sync {}: {}", temporary_.string(), std::strerror(errno)));
    const fs::path old = give_name();
    committed_ = true;
    if (durable_) sync_to_disk(folder_of(target_));
    if (!old.empty()) fs::remove_all(old);
  } catch (const fs::filesystem_error& e) {
    fail(e);
  }
}

}  // namespace vitrail
