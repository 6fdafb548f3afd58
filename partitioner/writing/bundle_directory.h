// SPDX-License-Identifier: Apache-2.0
// A BundleDirectory is a bundle that appears whole or not at all.
#pragma once

#include <filesystem>

namespace vitrail {

// Makes `target`.tmp<pid> with its domains/ beside the target; `commit` renames it to the target, where it
// replaces an older bundle. Without a commit the destructor removes it; after a kill the next one for the
// same target does. A lock on the directory says whether its process lives. A target that exists and is not
// a bundle is never touched: UsageError. Failures of the machine throw MachineError. A durable one is synced
// to the disk before it gets its name.
class BundleDirectory {
 public:
  explicit BundleDirectory(std::filesystem::path target, bool durable = false);
  ~BundleDirectory();
  BundleDirectory(const BundleDirectory&) = delete;
  BundleDirectory& operator=(const BundleDirectory&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path give_name() const;

  std::filesystem::path target_, temporary_;
  bool durable_ = false;
  int lock_ = -1;
  bool committed_ = false;
};

}  // namespace vitrail
