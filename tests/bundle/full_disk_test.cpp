// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/mount.h>

#include "bundle/manifest.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::full_disk_test {

namespace {

// 64 KiB of disk, where one may mount.
class SmallDisk {
 public:
  explicit SmallDisk(const std::filesystem::path& at) : at_(at) {
    mounted_ = ::mount("tmpfs", at.c_str(), "tmpfs", 0, "size=64k") == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount(at_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::filesystem::path at_;
  bool mounted_ = false;
};

DomainContent large_domain() {
  DomainContent content = test::sample_domain();
  content.piece_vertices.resize(content.pieces[0].vertex_count = 10'000);
  return content;
}

TEST(FullDisk, IsTheMachineAndLeavesNoFile) {
  const test::TemporaryDirectory directory;
  const SmallDisk disk(directory.path());
  if (!disk.mounted()) GTEST_SKIP() << "mounting a small disk takes root";
  EXPECT_NO_THROW(write_domain_file(directory.path() / "small.dom", test::sample_domain()));
  EXPECT_THROW(write_domain_file(directory.path() / "large.dom", large_domain()), MachineError);
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "large.dom"));
}

TEST(FullDisk, UnwritableDirectory) {
  // Not even root creates files there.
  EXPECT_THROW(write_domain_file("/proc/000000.dom", test::sample_domain()), MachineError);
  EXPECT_THROW(write_manifest("/proc", test::sample_manifest()), MachineError);
}

}  // namespace

}  // namespace vitrail::full_disk_test
