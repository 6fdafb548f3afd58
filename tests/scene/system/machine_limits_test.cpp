// SPDX-License-Identifier: Apache-2.0
// What control groups allow, in trees of files as the kernel shows them.
#include "scene/system/machine_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_directory.h"

namespace vitrail::test::machine_limits_test {
namespace {

namespace fs = std::filesystem;

class MachineLimits : public ::testing::Test {
 protected:
  void put(const std::string& file, const std::string& text) {
    const fs::path path = directory_ / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text << '\n';
  }
  ControlGroupLimits limits(const std::string& own) { return control_group_limits(own, directory_.path()); }
  TemporaryDirectory directory_;
};

constexpr std::uint64_t nothing = std::numeric_limits<std::uint64_t>::max();

TEST_F(MachineLimits, NoGroupsLimitNothing) {
  EXPECT_EQ(limits("").bytes, nothing);
  EXPECT_EQ(limits("0::/\n").bytes, nothing);
  EXPECT_EQ(limits("no colons\n:\n").bytes, nothing);
  EXPECT_TRUE(std::isinf(limits("0::/a/b\n").processors));
}

// The tightest on the way up holds.
TEST_F(MachineLimits, Version2) {
  put("job/memory.max", "300000000");
  put("job/step/memory.max", "max");
  put("job/step/cpu.max", "150000 100000");
  put("job/cpu.max", "max 100000");
  const ControlGroupLimits own = limits("0::/job/step\n");
  EXPECT_EQ(own.bytes, 300000000u);
  EXPECT_EQ(own.processors, 1.5);
  put("job/step/memory.max", "200000000");
  EXPECT_EQ(limits("0::/job/step\n").bytes, 200000000u);
  EXPECT_EQ(limits("0::/job\n").bytes, 300000000u);
  EXPECT_EQ(limits("0::/other\n").bytes, nothing);
}

TEST_F(MachineLimits, Version1) {
  put("memory/memory.limit_in_bytes", "9223372036854771712");
  put("memory/job/memory.limit_in_bytes", "100000000");
  put("cpu,cpuacct/job/cpu.cfs_quota_us", "50000");
  put("cpu,cpuacct/job/cpu.cfs_period_us", "100000");
  put("cpu,cpuacct/cpu.cfs_quota_us", "-1");
  put("cpu,cpuacct/cpu.cfs_period_us", "100000");
  const ControlGroupLimits own = limits("8:memory:/job\n4:cpu,cpuacct:/job\n1:name=systemd:/x\n0::/\n");
  EXPECT_EQ(own.bytes, 100000000u);
  EXPECT_EQ(own.processors, 0.5);
  EXPECT_EQ(limits("8:memory:/\n").bytes, nothing);
}

// A container sees its own group at the top, and at times the host's path to it.
TEST_F(MachineLimits, Containers) {
  put("memory.max", "64000000");
  EXPECT_EQ(limits("0::/\n").bytes, 64000000u);
  EXPECT_EQ(limits("0::/docker/0123\n").bytes, 64000000u);
  EXPECT_EQ(limits("0::/../..\n").bytes, 64000000u);
}

TEST_F(MachineLimits, ThisProcessHasSome) {
  EXPECT_GT(memory_limit().bytes, 1u << 20);
  EXPECT_GE(processors_allowed(), 1);
  EXPECT_EQ(threads_for(0), processors_allowed());
  EXPECT_EQ(threads_for(3), 3);
  EXPECT_EQ(threads_for(4096), std::max(64, 4 * processors_allowed()));
}

}  // namespace
}  // namespace vitrail::test::machine_limits_test
