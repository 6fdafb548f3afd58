// SPDX-License-Identifier: Apache-2.0
// Streams and disks that take nothing: no work is lost for it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "film/film_progress.h"
#include "tests/support/partitioned_box.h"

namespace vitrail::test::failing_machine_test {
namespace {

using ::testing::HasSubstr;

class FailingMachine : public PartitionedBox {
 protected:
  FailingMachine() : PartitionedBox(2) {}
  std::string arguments(const std::string& out, const std::string& more) const {
    return fmt::format("'{}' -o '{}' --crop 0,32,0,32 --threads 1 {} {}", path("box.vit"), out,
                       more.find("--spp") == std::string::npos ? "--spp 4" : "", more);
  }
  std::string line(const std::string& out, const std::string& more) const {
    return vitrail("render ") + arguments(path(out), more);
  }
};

TEST_F(FailingMachine, FullOrClosedStreamsLoseNothing) {
  ASSERT_EQ(run(line("a.film", "")).status, 0);
  const std::uint64_t hash = read_film(path("a.film"), nullptr).hash();
  int number = 0;
  for (const char* streams :
       {"--progress bar 2>/dev/full", "--progress lines 2>&-", "--progress json >/dev/full",
        "--progress json >&- 2>&- <&-", "--progress json 2>/dev/full | true"}) {
    const std::string out = fmt::format("{}.film", ++number);
    // A shell of its own: what `run` adds is not its streams'.
    const CommandResult made = run(fmt::format("sh -c \"{}\"", line(out, streams)));
    EXPECT_EQ(made.status, 0) << streams << made.output;
    ASSERT_TRUE(std::filesystem::exists(path(out))) << streams;
    EXPECT_EQ(read_film(path(out), nullptr).hash(), hash) << streams;
  }
}

TEST_F(FailingMachine, AFullStreamDoesNotChangeTheStatus) {
  EXPECT_EQ(run(fmt::format("sh -c \"{}\"", vitrail("render ") + "no-such.vit 2>/dev/full")).status, 3);
  EXPECT_EQ(
      run(fmt::format("sh -c \"{}\"", vitrail("partition ") + "no-such.pbrt -o x.vit 2>/dev/full")).status,
      3);
}

// A disk of its own for one command, in the folder that $D names; what runs there sees nothing of the others.
std::string on_small_disk(const std::string& folder, std::uint64_t bytes, const std::string& line) {
  return fmt::format("D='{0}' unshare -m sh -c 'mount -t tmpfs -o size={1} tmpfs {0} || exit 99; {2}'",
                     folder, bytes, line);
}

class SmallDisk : public FailingMachine {
 protected:
  void SetUp() override {
    if (run("unshare -m mount -t tmpfs tmpfs /mnt").status != 0) GTEST_SKIP() << "no right to mount a disk";
    FailingMachine::SetUp();
    for (const char* folder : {"disk", "spare", "kept"}) std::filesystem::create_directory(path(folder));
    ASSERT_EQ(run(line("whole.film", samples_)).status, 0);
    whole_ = read_film(path("whole.film"), nullptr).hash();
    film_bytes_ = std::filesystem::file_size(path("whole.film"));
  }
  // The shell's quotes are those of on_small_disk.
  std::string render(const std::string& more) const {
    std::string text = line("disk/a.film", more + " --progress none " + samples_);
    std::erase(text, '\'');
    return text;
  }
  std::uint64_t hash(const std::string& film) const { return read_film(path(film), nullptr).hash(); }
  std::uint64_t disk(double films) const {
    return static_cast<std::uint64_t>(films * static_cast<double>(film_bytes_));
  }

  const std::string samples_ = "--spp 256";  // long enough for checkpoints
  std::uint64_t whole_ = 0, film_bytes_ = 0;
};

TEST_F(SmallDisk, AFilmThatDoesNotFitIsElsewhere) {
  // The checkpoint is there when the film comes, and both do not fit.
  const std::string stopped = render("--checkpoint-every .05");
  const CommandResult failed =
      run(on_small_disk(path("disk"), disk(1.7),
                        fmt::format("cd {0} && TMPDIR={0} {1}; s=$?; cp $D/a.film.partial {2}; exit $s",
                                    path("spare"), stopped, path("kept"))));
  EXPECT_EQ(failed.status, 4) << failed.output;
  EXPECT_THAT(failed.output, HasSubstr("No space left"));
  EXPECT_THAT(failed.output, HasSubstr("trying again"));
  EXPECT_THAT(failed.output, HasSubstr("the rendered samples are in " + path("spare/a.film")));
  EXPECT_EQ(hash("spare/a.film"), whole_);
  // What it says helps: the film is known where it belongs, and the checkpoint can be gone on from.
  std::filesystem::rename(path("spare/a.film"), path("kept/a.film"));
  EXPECT_THAT(run(line("kept/a.film", samples_)).output, HasSubstr("finished already"));
  std::filesystem::remove(path("kept/a.film"));
  EXPECT_EQ(run(line("kept/a.film", samples_)).status, 0);
  EXPECT_EQ(hash("kept/a.film"), whole_);
}

TEST_F(SmallDisk, AFullDiskIsKnownBeforehand) {
  const CommandResult refused = run(on_small_disk(path("disk"), film_bytes_ / 2, render("")));
  EXPECT_EQ(refused.status, 4);
  EXPECT_THAT(refused.output, HasSubstr("No space left for"));
  EXPECT_THAT(refused.output, ::testing::Not(HasSubstr("trying again")));
}

TEST_F(SmallDisk, WhatOthersWriteDoesNotTakeTheFilmsRoom) {
  const std::string both = fmt::format(
      "{} & sleep .2; dd if=/dev/zero of=$D/other bs=4k 2>/dev/null; wait $!; s=$?; cp $D/a.film {}; exit $s",
      render(""), path("kept"));
  const CommandResult made = run(on_small_disk(path("disk"), disk(2.5), both));
  EXPECT_EQ(made.status, 0) << made.output;
  EXPECT_EQ(made.output, "");
  EXPECT_TRUE(std::filesystem::exists(path("kept/a.film")));
}

TEST_F(SmallDisk, AFilmInFilesHasItsRoomOrIsRefused) {
  const auto large = [&](const std::string& film, const std::string& more) {
    std::string text = vitrail("render ") + path("box.vit") + " -o " + path(film) +
                       " --width 400 --height 300 --spectral 47 --spp 1 --threads 2 --quiet " + more;
    std::erase(text, '\'');
    return text;
  };
  constexpr std::uint64_t film_bytes = 400 * 300 * 824, mib = 1 << 20;
  const std::string in_files = "TMPDIR=$D " + large("kept/files.film", "--memory 64M --stats " + path("s"));
  const CommandResult refused = run(on_small_disk(path("disk"), film_bytes - mib, in_files));
  EXPECT_EQ(refused.status, 4) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("have no room in " + path("disk") + ": No space left"));
  EXPECT_THAT(refused.output, HasSubstr("TMPDIR names another place"));
  EXPECT_FALSE(std::filesystem::exists(path("kept/files.film")));
  const CommandResult made = run(on_small_disk(path("disk"), film_bytes + mib, in_files));
  ASSERT_EQ(made.status, 0) << made.output;
  EXPECT_GT(read_json(path("s"))["film_window_bytes"], 0);
  ASSERT_EQ(run(large("kept/memory.film", "")).status, 0);
  EXPECT_EQ(hash("kept/files.film"), hash("kept/memory.film"));
}

// A limit to the size of files is no death by SIGXFSZ, and holds in every folder.
TEST_F(FailingMachine, WhatFitsNowhereIsSaid) {
  const CommandResult failed =
      run(fmt::format("sh -c \"ulimit -f 8; cd {}; {}\"", directory_.path().string(), line("a.film", "")));
  EXPECT_EQ(failed.status, 4) << failed.output;
  EXPECT_THAT(failed.output, HasSubstr("File too large"));
}

TEST_F(FailingMachine, ACheckpointCutAnywhereIsRefused) {
  ASSERT_EQ(run(line("a.film", "")).status, 0);
  const auto whole = path("a.film"), partial = path("b.film.partial");
  const std::uint64_t bytes = std::filesystem::file_size(whole);
  constexpr std::uint64_t header = 184;
  for (const std::uint64_t length :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{8}, header - 1, header, header + 1, header + 9,
        bytes / 4, bytes / 2, bytes - 4096, bytes - 8, bytes - 1, bytes + 1, bytes + 8}) {
    std::filesystem::copy_file(whole, partial, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(partial, length);
    const CommandResult refused = run(line("b.film", ""));
    EXPECT_EQ(refused.status, 3) << length << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("b.film.partial: ")) << length;
    EXPECT_FALSE(std::filesystem::exists(path("b.film"))) << length;
  }
}

}  // namespace
}  // namespace vitrail::test::failing_machine_test
