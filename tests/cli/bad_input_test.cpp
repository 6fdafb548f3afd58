// SPDX-License-Identifier: Apache-2.0
// What a user sees when the input or the machine is bad: a message with its place, the right exit status, and
// nothing under the final name.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::bad_input_test {
namespace {

using ::testing::HasSubstr;

class BadInput : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }
  CommandResult partition(const std::string& scene, const std::string& out = "out.vit") const {
    return run(fmt::format("{} '{}' -o '{}' --domains 4", vitrail("partition"), (directory_ / scene).string(),
                           (directory_ / out).string()));
  }
  void expect_refused(const std::string& scene, const std::string& place, const std::string& message) const {
    const CommandResult result = partition(scene);
    EXPECT_EQ(result.status, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr(place));
    EXPECT_THAT(result.output, HasSubstr(message));
    expect_nothing_left();
  }
  // Neither the bundle nor a temporary one.
  void expect_nothing_left() const {
    for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
      EXPECT_THAT(entry.path().filename().string(), ::testing::Not(HasSubstr("out.vit")));
  }
  // A bundle of the cornell box to damage.
  std::filesystem::path good_bundle() const {
    const auto bundle = directory_ / "good.vit";
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 4",
                        vitrail("partition"), source_dir(), bundle.string()));
    EXPECT_EQ(made.status, 0) << made.output;
    return bundle;
  }
  CommandResult render(const std::filesystem::path& bundle, const std::string& out, int ranks = 1) const {
    return run(fmt::format("{} '{}' -o '{}' --spp 1 --crop 0,32,0,32",
                           ranks > 1 ? mpi_vitrail("render", ranks) : vitrail("render"), bundle.string(),
                           (directory_ / out).string()));
  }
  TemporaryDirectory directory_;
};

const std::string head = "WorldBegin\n";
const std::string square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" ";

TEST_F(BadInput, MissingInclude) {
  write("a.pbrt", head + "Include \"nowhere.pbrt\"\n");
  expect_refused("a.pbrt", "a.pbrt:2:", "nowhere.pbrt");
}

TEST_F(BadInput, TruncatedPly) {
  write("t.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\nabc");
  write("a.pbrt", head + "Shape \"plymesh\" \"string filename\" \"t.ply\"\n");
  expect_refused("a.pbrt", "t.ply", "");
}

TEST_F(BadInput, IndexOutOfRange) {
  write("a.pbrt",
        head + "Shape \"trianglemesh\" \"integer indices\" [0 1 7] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n");
  expect_refused("a.pbrt", "a.pbrt:2:", "7");
}

TEST_F(BadInput, NanVertex) {
  write("a.pbrt", head + square + "[0 0 0 1 0 nan 0 1 0]\n");
  expect_refused("a.pbrt", "a.pbrt:2:", "");
}

TEST_F(BadInput, UnknownDirectiveSuggestsTheNearest) {
  write("a.pbrt", head + "Shapes \"sphere\"\n");
  expect_refused("a.pbrt", "a.pbrt:2:1", "Shape");
}

TEST_F(BadInput, UnknownParameterIsReportedAndStrictRefusesIt) {
  write("a.pbrt", head + "Shape \"sphere\" \"float radios\" [2]\n");
  const CommandResult result = partition("a.pbrt");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("a.pbrt:2:"));
  EXPECT_THAT(result.output, HasSubstr("radios"));
  EXPECT_THAT(result.output, HasSubstr("radius"));
  std::filesystem::remove_all(directory_ / "out.vit");
  EXPECT_EQ(partition("a.pbrt", "out.vit' --strict '").status, 2) << "a stray argument";
  const CommandResult strict =
      run(fmt::format("{} '{}' -o '{}' --strict", vitrail("partition"), (directory_ / "a.pbrt").string(),
                      (directory_ / "out.vit").string()));
  EXPECT_EQ(strict.status, 3) << strict.output;
  expect_nothing_left();
}

TEST_F(BadInput, MissingScene) {
  const CommandResult result = partition("none.pbrt");
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("none.pbrt"));
}

TEST_F(BadInput, CorruptDomainFile) {
  const auto bundle = good_bundle();
  const auto domain = bundle / "domains" / "000000.dom";
  {
    // Behind the header, all over the sections that are traced.
    std::fstream file(domain, std::ios::in | std::ios::out | std::ios::binary);
    for (std::uintmax_t at = 1024; at < std::filesystem::file_size(domain); at += 256) {
      file.seekp(static_cast<std::streamoff>(at));
      file.put('\x5a').put('\x17').put('\x33');
    }
  }
  for (const int ranks : {1, 2}) {
    const CommandResult result = render(bundle, "picture.png", ranks);
    EXPECT_EQ(result.status, 3) << result.output;
    EXPECT_THAT(result.output, HasSubstr("000000.dom"));
    if (ranks > 1) {
      EXPECT_THAT(result.output, HasSubstr(" of 2: "));
    }
    EXPECT_FALSE(std::filesystem::exists(directory_ / "picture.png"));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "picture.film"));
  }
}

TEST_F(BadInput, TruncatedDomainFile) {
  const auto bundle = good_bundle();
  const auto domain = bundle / "domains" / "000001.dom";
  std::filesystem::resize_file(domain, std::filesystem::file_size(domain) / 2);
  const CommandResult result = render(bundle, "picture.png");
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("000001.dom"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "picture.film"));
}

TEST_F(BadInput, DamagedManifest) {
  const auto bundle = good_bundle();
  std::ofstream(bundle / "manifest.json") << "{\"format\":";
  const CommandResult result = render(bundle, "picture.png");
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("manifest.json"));
}

TEST_F(BadInput, DirectoryThatDoesNotExistOrCannotBeWritten) {
  const auto bundle = good_bundle();
  const CommandResult picture = render(bundle, "no/such/folder/picture.png");
  EXPECT_EQ(picture.status, 4) << picture.output;
  EXPECT_THAT(picture.output, HasSubstr("no/such/folder"));
  write("a.pbrt", head + "Shape \"sphere\"\n");
  const CommandResult bundled = run(fmt::format("{} '{}' -o /proc/nowhere/out.vit", vitrail("partition"),
                                                (directory_ / "a.pbrt").string()));
  EXPECT_EQ(bundled.status, 4) << bundled.output;
  EXPECT_THAT(bundled.output, HasSubstr("/proc/nowhere"));
}

TEST_F(BadInput, FullDisk) {
  if (::geteuid() != 0) GTEST_SKIP() << "mounting a small disk takes root";
  const auto disk = directory_ / "disk";
  std::filesystem::create_directory(disk);
  if (run(fmt::format("mount -t tmpfs -o size=64k none '{}'", disk.string())).status != 0)
    GTEST_SKIP() << "this machine does not let us mount a small disk";
  const auto bundle = good_bundle();
  write("a.pbrt", head +
                      "Shape \"loopsubdiv\" \"integer levels\" 6 \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] "
                      "\"integer indices\" [0 2 1 0 1 3 1 2 3 2 0 3]\n");
  const CommandResult bundled = partition("a.pbrt", "disk/out.vit");
  const CommandResult picture = run(fmt::format("{} '{}' -o '{}' --spp 1", vitrail("render"), bundle.string(),
                                                (disk / "picture.film").string()));
  const bool empty = std::filesystem::is_empty(disk);
  run(fmt::format("umount '{}'", disk.string()));
  for (const CommandResult* result : {&bundled, &picture}) {
    EXPECT_EQ(result->status, 4) << result->output;
    EXPECT_THAT(result->output, HasSubstr("No space left"));
  }
  EXPECT_TRUE(empty);
}

// Of two ranks each is started with arguments of its own.
TEST_F(BadInput, RanksThatRenderDifferentPictures) {
  const std::string bundle = "'" + good_bundle().string() + "' --crop 0,32,0,32";
  write("b.pbrt", head + square + "[0 0 0 2 0 0 0 1 0]\n");
  ASSERT_EQ(partition("b.pbrt", "other.vit").status, 0);
  const auto two_ranks = [&](const std::string& first, const std::string& second) {
    const std::string out = fmt::format(" -o '{}'", (directory_ / "picture.film").string());
    return run(fmt::format("timeout 60 env {} {}{} : -np 1 {} {}{}", mpi_vitrail("render", 1), first, out,
                           vitrail("render"), second, out));
  };
  EXPECT_EQ(two_ranks(bundle + " --spp 4", bundle + " --spp 4").status, 0);
  const struct {
    std::string other, what;
  } cases[] = {{bundle + " --spp 4 --seed 7", "seed"},
               {bundle + " --spp 5", "number of samples"},
               {bundle + " --spp 4 --max-depth 1", "depth"},
               {bundle + " --spp 4 --roulette never", "way to sample"},
               {fmt::format("'{}' --crop 0,32,0,32 --spp 4", (directory_ / "other.vit").string()), "bundle"}};
  for (const auto& [other, what] : cases) {
    std::filesystem::remove(directory_ / "picture.film");
    const CommandResult result = two_ranks(bundle + " --spp 4", other);
    EXPECT_EQ(result.status, 2) << what << " (124: it hangs)";
    EXPECT_THAT(result.output, HasSubstr("was given another")) << what;
    EXPECT_THAT(result.output, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "picture.film"));
  }
}

// Memory for the stacks of ten thousand threads is not there.
TEST_F(BadInput, TooManyThreads) {
  for (const int ranks : {1, 2}) {
    const std::string render = ranks > 1 ? mpi_vitrail("render", ranks) : vitrail("render");
    const CommandResult result = run(fmt::format(
        "ulimit -v 600000; timeout 60 env {} '{}' -o '{}' --spp 1 --crop 0,32,0,32 --threads 4000", render,
        good_bundle().string(), (directory_ / "picture.film").string()));
    EXPECT_NE(result.status, 124) << "it hangs";
    EXPECT_NE(result.status, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("threads can be made"));
  }
}

TEST_F(BadInput, TooLittleMemory) {
  const CommandResult result =
      run(fmt::format("{} '{}' -o '{}' --memory 1M", vitrail("render"), good_bundle().string(),
                      (directory_ / "picture.film").string()));
  EXPECT_EQ(result.status, 4) << result.output;
  EXPECT_THAT(result.output, HasSubstr("Give at least"));
}

TEST_F(BadInput, WrongUsage) {
  EXPECT_EQ(run(vitrail("render")).status, 2);
  EXPECT_EQ(run(vitrail("rendr x")).status, 2);
  EXPECT_EQ(run(fmt::format("{} '{}' -o '{}'", vitrail("render"), good_bundle().string(),
                            (directory_ / "picture.bmp").string()))
                .status,
            2);
  EXPECT_EQ(run(vitrail("render --help")).status, 0);
}

}  // namespace
}  // namespace vitrail::test::bad_input_test
