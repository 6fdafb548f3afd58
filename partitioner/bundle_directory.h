// SPDX-License-Identifier: Apache-2.0
// A bundle that appears whole or not at all.
#pragma once

#include <filesystem>

namespace vitrail {

// Makes `target`.tmp<pid> with its domains/ beside the target; `commit` renames it to the target, where it
// replaces an older bundle. Without a commit the destructor removes it, and where the process was killed the
// next one for the same target does: a lock on the directory says whether its process lives. A target that
// exists and is not a bundle is never touched: UsageError. What the machine refuses throws MachineError.
// Nothing is synced to the disk, which would take longer than the rest: a bundle can be made again, and after
// a power failure its checksums tell whether it is whole.
class BundleDirectory {
 public:
  explicit BundleDirectory(std::filesystem::path target);
  ~BundleDirectory();
  BundleDirectory(const BundleDirectory&) = delete;
  BundleDirectory& operator=(const BundleDirectory&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  int lock_ = -1;
  bool committed_ = false;
};

}  // namespace vitrail
