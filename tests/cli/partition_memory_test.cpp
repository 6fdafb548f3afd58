// SPDX-License-Identifier: Apache-2.0
// Partitioning scenes larger than memory as a user sees it: the budget is kept, the picture stays, and
// neither kills nor full disks leave anything behind.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "importers/writing/write_ply.h"
#include "tests/partitioner/bundle_contents.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::test::partition_memory_test {
namespace {

class PartitionMemory : public ::testing::Test {
 protected:
  // `tori` of 2n² triangles each, every one with a file of its own.
  void write_scene(int tori, int n) const {
    std::ofstream scene = begun_scene(tori, n);
    for (int i = 0; i < tori; ++i) {
      scene << fmt::format("AttributeBegin\nTranslate {} {} {}\nRotate {} 1 1 0\n", 4 * (i % 4) - 6,
                           3 * (i / 4) - 5, i % 3, 40 * i)
            << fmt::format("Shape \"plymesh\" \"string filename\" \"{}.ply\"\nAttributeEnd\n", i);
    }
  }
  // The tori as objects that do not stand anywhere but in `instances` places.
  void write_instances(int tori, int n, int instances) const {
    std::ofstream scene = begun_scene(tori, n);
    for (int i = 0; i < tori; ++i)
      scene << fmt::format(
          "ObjectBegin \"{0}\"\nShape \"plymesh\" \"string filename\" \"{0}.ply\"\nObjectEnd\n", i);
    for (int i = 0; i < instances; ++i)
      scene << fmt::format("AttributeBegin\nTranslate {} {} 0\nObjectInstance \"{}\"\nAttributeEnd\n",
                           3 * (i % 100), 3 * (i / 100), i % tori);
  }
  std::ofstream begun_scene(int tori, int n) const {
    write_ply(bumpy_torus(n), directory_ / "torus.ply");
    for (int i = 0; i < tori; ++i)
      std::filesystem::create_symlink("torus.ply", directory_ / fmt::format("{}.ply", i));
    std::ofstream scene(directory_ / "scene.pbrt");
    scene << "LookAt 0 0 30 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
             "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\n"
             "WorldBegin\nLightSource \"infinite\"\n";
    return scene;
  }
  std::string command(const std::string& bundle, const std::string& more) const {
    return fmt::format("{} '{}' -o '{}' --stats '{}' {}", vitrail("partition"),
                       (directory_ / "scene.pbrt").string(), (directory_ / bundle).string(),
                       (directory_ / "stats.json").string(), more);
  }
  nlohmann::json partition(const std::string& bundle, const std::string& more) const {
    const CommandResult done = run(command(bundle, more));
    EXPECT_EQ(done.status, 0) << done.output;
    return done.status == 0 ? read_json(directory_ / "stats.json") : nlohmann::json();
  }
  std::string film_hash(const std::string& bundle) const {
    const auto stats = directory_ / "render.json";
    const CommandResult done = run(fmt::format("{} '{}' -o '{}' --force --spp 2 --stats '{}'",
                                               vitrail("render"), (directory_ / bundle).string(),
                                               (directory_ / "picture.film").string(), stats.string()));
    EXPECT_EQ(done.status, 0) << done.output;
    return done.status == 0 ? read_json(stats)["film_hash"].get<std::string>() : "";
  }
  std::vector<std::string> names_with(const std::string& part) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
      if (const std::string name = entry.path().filename().string(); name.find(part) != std::string::npos)
        names.push_back(name);
    return names;
  }
  TemporaryDirectory directory_;
};

TEST_F(PartitionMemory, BudgetIsKeptAndThePictureStays) {
  write_scene(16, 360);  // 4.1 million triangles
  constexpr std::uint64_t budget = 192u << 20;
  const nlohmann::json little = partition("little.vit", "--memory 192M");
  const nlohmann::json plenty = partition("plenty.vit", "--domains 5");
  EXPECT_LE(little["peak_rss_bytes"].get<std::uint64_t>(), budget);
  EXPECT_EQ(little["memory_budget_bytes"], budget);
  EXPECT_GT(little["buckets"], 2);
  EXPECT_GT(plenty["peak_rss_bytes"].get<std::uint64_t>(), 2 * budget) << "the scene is too small to tell";
  EXPECT_EQ(plenty["buckets"], 1);
  for (const auto& stats : {little, plenty}) {
    EXPECT_EQ(stats["duplicates"], 0);
    EXPECT_LT(stats["area_error"], 1e-6);
    EXPECT_LT(stats["triangles_max"].get<double>(), 1.3 * stats["triangles_mean"].get<double>());
  }
  EXPECT_EQ(film_hash("little.vit"), film_hash("plenty.vit"));
}

TEST_F(PartitionMemory, ObjectsKeepTheBudget) {
  write_instances(6, 360, 10'000);  // 260,000 triangles each
  const nlohmann::json stats = partition("out.vit", "--memory 128M");
  EXPECT_EQ(stats["objects"], 6);
  EXPECT_LE(stats["peak_rss_bytes"].get<std::uint64_t>(), 128u << 20);
  EXPECT_EQ(run(command("no.vit", "--memory 80M")).status, 4) << "the objects are too small to tell";
}

// The child that runs it, without the shell.
pid_t start(const std::string& command) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::execl("/bin/sh", "sh", "-c", ("exec " + command + " >/dev/null 2>&1").c_str(), nullptr);
    ::_exit(127);
  }
  return pid;
}

int wait_for(pid_t pid) {
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// The front program becomes the verb's, so that a signal reaches it.
TEST_F(PartitionMemory, KilledAtAnyMoment) {
  write_scene(5, 150);
  const std::string again = command("out.vit", "--domains 12 --domains-at-once 3");
  const auto begin = std::chrono::steady_clock::now();
  partition("whole.vit", "--domains 12 --domains-at-once 3");
  auto whole = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(20261121);
  int killed = 0;
  for (int tries = 0; killed < 10; ++tries) {
    ASSERT_LT(tries, 60);
    const pid_t pid = start(again);
    std::this_thread::sleep_for(whole * std::uniform_real_distribution(0.1, 0.9)(random));
    ::kill(pid, SIGKILL);
    if (wait_for(pid) == 128 + SIGKILL)
      ++killed;
    else
      whole = whole * 9 / 10;  // it ended first: this machine's speed is not what it was
    EXPECT_LE(names_with("out.vit.tmp").size(), 1u) << "what an earlier one left is gone";
  }
  ASSERT_EQ(run(again).status, 0);
  EXPECT_THAT(names_with("out.vit"), ::testing::ElementsAre("out.vit"));
  EXPECT_TRUE(contents(directory_ / "out.vit") == contents(directory_ / "whole.vit"));
}

TEST_F(PartitionMemory, TermLeavesNothing) {
  write_scene(5, 400);
  const pid_t pid = start(command("out.vit", "--domains 40 --domains-at-once 3"));
  while (names_with("out.vit.tmp").empty()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ::kill(pid, SIGTERM);
  EXPECT_EQ(wait_for(pid), 128 + SIGTERM);
  EXPECT_TRUE(names_with("out.vit").empty());
}

TEST_F(PartitionMemory, FullDisk) {
  if (::geteuid() != 0) GTEST_SKIP() << "mounting a small disk takes root";
  const auto disk = directory_ / "disk";
  std::filesystem::create_directory(disk);
  write_scene(5, 100);
  for (const char* size : {"1m", "7m"}) {  // full of parts; of domains
    if (run(fmt::format("mount -t tmpfs -o size={} none '{}'", size, disk.string())).status != 0)
      GTEST_SKIP() << "this machine does not let us mount a small disk";
    const CommandResult result = run(command("disk/out.vit", "--domains 12 --domains-at-once 3"));
    const bool empty = std::filesystem::is_empty(disk);
    run(fmt::format("umount '{}'", disk.string()));
    EXPECT_EQ(result.status, 4) << result.output;
    EXPECT_THAT(result.output, ::testing::HasSubstr("No space left"));
    EXPECT_THAT(result.output, ::testing::HasSubstr("disk/out.vit.tmp"));
    EXPECT_TRUE(empty) << size;
  }
}

}  // namespace
}  // namespace vitrail::test::partition_memory_test
