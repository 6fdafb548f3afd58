// SPDX-License-Identifier: Apache-2.0
#include "partitioner/bundle_directory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "scene/diagnostics.h"

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

[[noreturn]] void fail(const fs::filesystem_error& e) {
  throw MachineError(fmt::format("cannot write {}: {}", e.path1().string(), e.code().message()));
}

}  // namespace

BundleDirectory::BundleDirectory(fs::path target) : target_(std::move(target)) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // a slash at the end
  if (target_.empty()) throw UsageError("the bundle has no name");
  temporary_ = beside(target_, "tmp");
  try {
    check_target(target_);
    fs::remove_all(temporary_);
    fs::create_directories(temporary_ / "domains");
  } catch (const fs::filesystem_error& e) {
    fail(e);
  }
}

BundleDirectory::~BundleDirectory() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(temporary_, ignored);
}

void BundleDirectory::commit() {
  try {
    check_target(target_);
    const fs::path old = beside(target_, "old");
    const bool replaces = fs::exists(target_);
    if (replaces) fs::rename(target_, old);
    try {
      fs::rename(temporary_, target_);
    } catch (...) {
      if (replaces) fs::rename(old, target_);
      throw;
    }
    committed_ = true;
    if (replaces) fs::remove_all(old);
  } catch (const fs::filesystem_error& e) {
    fail(e);
  }
}

}  // namespace vitrail
