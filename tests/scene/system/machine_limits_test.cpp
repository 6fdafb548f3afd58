// SPDX-License-Identifier: Apache-2.0
// What control groups allow, in trees of files as the kernel shows them.
#include "scene/system/machine_limits.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

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

// As Slurm 22.05 says it of jobs and steps, and newer ones of jobs.
TEST(MemoryOfSlurm, IsReadFromWhatScontrolSays) {
  constexpr std::uint64_t mib = 1 << 20;
  EXPECT_EQ(memory_a_node("JobId=1 NumCPUs=1 TRES=cpu=1,mem=200M,node=1,billing=1 MinMemoryNode=200M\n"),
            200 * mib);
  EXPECT_EQ(memory_a_node("StepId=7.0 CPUs=1 TRES=cpu=1,mem=100M,node=1 ResvPorts=(null)\n"), 100 * mib);
  EXPECT_EQ(memory_a_node("ReqTRES=cpu=8,mem=64G,node=4 AllocTRES=cpu=8,mem=6000M,node=4\n"), 1500 * mib);
  EXPECT_EQ(memory_a_node("TRES=cpu=1,mem=1.50G,node=1"), 1536 * mib);
  EXPECT_EQ(memory_a_node("TRES=mem=2T,cpu=1"), 2 * mib * mib);
  EXPECT_EQ(memory_a_node("TRES=cpu=1,mem=300,node=1"), 300 * mib) << "MiB without a unit";
  for (const char* nothing_said : {"", "JobId=1 NumCPUs=1", "TRES=cpu=1,node=1", "TRES=(null)", "TRES="})
    EXPECT_EQ(memory_a_node(nothing_said), 0u) << nothing_said;
}

// Variables of this process, and a scontrol of its own.
class InSlurm : public MachineLimits {
 protected:
  InSlurm() {
    set("SLURM_JOB_ID", "7");
    set("PATH", directory_.path().string() + ":" + std::getenv("PATH"));
  }
  ~InSlurm() override {
    for (const auto& [name, value] : before_)
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
  }
  void set(const std::string& name, const std::string& value) {
    const char* const now = std::getenv(name.c_str());
    before_.try_emplace(name, now ? std::optional<std::string>(now) : std::nullopt);
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  // Answers one question.
  void answer(const std::string& question, const std::string& text) {
    put("scontrol", "#!/bin/sh\n[ \"$*\" = \"" + question + "\" ] && echo '" + text + "'");
    fs::permissions(directory_ / "scontrol", fs::perms::owner_all);
  }
  static constexpr std::uint64_t mib = 1 << 20;

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

// srun leaves its --mem in no variable.
TEST_F(InSlurm, TheLeastOfWhatIsSaidIsTaken) {
  answer("-o show job 7", "JobId=7 TRES=cpu=1,mem=200M,node=1");
  EXPECT_EQ(slurm_memory(), 200 * mib);
  set("SLURM_MEM_PER_NODE", "400");
  EXPECT_EQ(slurm_memory(), 200 * mib);
  set("SLURM_MEM_PER_NODE", "100");
  EXPECT_EQ(slurm_memory(), 100 * mib);
  set("SLURM_STEP_ID", "2");
  answer("-o show step 7.2", "StepId=7.2 TRES=cpu=1,mem=50M,node=1");
  EXPECT_EQ(slurm_memory(), 50 * mib);
  EXPECT_STREQ(memory_limit().giver, "Slurm");
  EXPECT_EQ(memory_limit().share(3), 15 * mib);
  set("SLURM_JOB_ID", "0");
  EXPECT_EQ(slurm_memory(), 0u) << "in no job";
}

// As --mem=0 without a scontrol that answers.
TEST_F(InSlurm, NothingSaidIsNoLimit) {
  answer("-o show job 8", "");
  EXPECT_EQ(slurm_memory(), 0u);
  set("SLURM_MEM_PER_CPU", "100");
  set("SLURM_CPUS_ON_NODE", "3");
  EXPECT_EQ(slurm_memory(), 300 * mib);
}

TEST_F(InSlurm, ThreadsAreThoseOfTheTask) {
  set("SLURM_CPUS_ON_NODE", "1");
  EXPECT_EQ(processors_allowed(), 1);
  set("SLURM_CPUS_ON_NODE", "512");
  set("SLURM_STEP_TASKS_PER_NODE", "512(x2),7");
  EXPECT_EQ(processors_allowed(), 1) << "shared by the tasks of the node";
  set("SLURM_CPUS_PER_TASK", "1");
  set("SLURM_STEP_TASKS_PER_NODE", "2");
  EXPECT_EQ(processors_allowed(), 1);
  set("SLURM_JOB_ID", "0");
  EXPECT_EQ(processors_allowed(), threads_for(0));
}

TEST_F(MachineLimits, AProgramLeavesSomeToOthers) {
  EXPECT_EQ((MemoryLimit{1000, "Slurm", false}.share()), 900u);
  EXPECT_EQ((MemoryLimit{1000, "the machine", true}.share()), 750u);
  EXPECT_EQ((MemoryLimit{1000, "the control group", false}.share(3)), 300u);
}

// One that a mask allows a single processor.
TEST_F(MachineLimits, ThreadsFollowAffinity) {
  cpu_set_t all, one;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(processors_allowed(), 1);
  ASSERT_EQ(::sched_setaffinity(0, sizeof all, &all), 0);
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
