// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>

#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"
#include "tests/support/temporary_directory.h"

// In place of the library's: counts.
static int file_syncs = 0, file_system_syncs = 0;
extern "C" int fsync(int descriptor) {
  ++file_syncs;
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}
extern "C" int syncfs(int descriptor) noexcept {
  ++file_system_syncs;
  return static_cast<int>(::syscall(SYS_syncfs, descriptor));
}

namespace vitrail::files_and_messages_test {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(AtomicFile& file, std::string_view text) { file.write(std::as_bytes(std::span(text))); }

TEST(AtomicFile, AppearsOnCommitAlone) {
  const test::TemporaryDirectory directory;
  std::ofstream(directory / "a") << "old";
  {
    AtomicFile file(directory / "a");
    write(file, "new ");
    write(file, "text");
    EXPECT_EQ(file.size(), 8u);
    EXPECT_EQ(content(directory / "a"), "old");
    file.commit();
  }
  EXPECT_EQ(content(directory / "a"), "new text");
}

// As redirecting a shell's output does. The first is not there before, the second is.
TEST(AtomicFile, ReplacesWhatALinkStandsFor) {
  const test::TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "disk");
  std::filesystem::create_symlink("disk/film", directory / "link");
  for (const char* text : {"first", "second"}) {
    AtomicFile out(directory / "link");
    write(out, text);
    out.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
    EXPECT_EQ(content(directory / "disk/film"), text);
  }
  std::ofstream(directory / "disk/film.tmp12") << "of a killed run";
  remove_temporaries(directory / "link");
  EXPECT_FALSE(std::filesystem::exists(directory / "disk/film.tmp12"));
}

TEST(OutputPlace, HasRoomForTheTemporaryFilesName) {
  const test::TemporaryDirectory directory;
  EXPECT_NO_THROW(require_place(directory / std::string(200, 'n')));
  EXPECT_THROW(require_place(directory / std::string(250, 'n')), UsageError);
}

// Known before the work begins: what is written lies behind the link.
TEST(OutputPlace, OfALinkIsThatOfTheFileBehindIt) {
  namespace fs = std::filesystem;
  const test::TemporaryDirectory directory;
  fs::create_symlink("nowhere/film", directory / "lost");
  EXPECT_THROW(require_place(directory / "lost"), MachineError);
  EXPECT_THROW(require_folder_of(directory / "lost"), MachineError);
  fs::create_symlink(std::string(250, 'n'), directory / "long");
  EXPECT_THROW(require_place(directory / "long"), UsageError);
  fs::create_symlink("other", directory / "one");
  fs::create_symlink("one", directory / "other");
  EXPECT_THROW(require_place(directory / "one"), MachineError);
  fs::create_directory(directory / "disk");
  fs::create_symlink("disk/film", directory / "link");
  EXPECT_NO_THROW(require_place(directory / "link"));
  EXPECT_EQ(behind_links(directory / "link"), directory / "disk/film");
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const test::TemporaryDirectory directory;
  {
    AtomicFile file(directory / "a");
    write(file, "half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  EXPECT_THROW(AtomicFile(directory / "nowhere/a"), MachineError);
}

TEST(AtomicFile, PartsReachTheDiskTogetherBeforeWhatSpeaksOfThem) {
  const test::TemporaryDirectory directory;
  file_syncs = file_system_syncs = 0;
  for (const char* name : {"a", "b", "c"}) {
    AtomicFile part(directory / name);
    write(part, name);
    part.commit_part();
    EXPECT_EQ(content(directory / name), name);
  }
  EXPECT_EQ(file_syncs + file_system_syncs, 0);
  for (const int waits : {1, 0}) {
    file_system_syncs = 0;
    AtomicFile whole(directory / "whole");
    write(whole, "abc");
    whole.commit();
    EXPECT_EQ(file_system_syncs, waits);
  }
}

TEST(AtomicFile, AFullDiskIsSaid) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const test::TemporaryDirectory directory;
  // The name that the temporary file will have leads to the full device.
  std::filesystem::create_symlink("/dev/full", directory / ("a.tmp" + std::to_string(::getpid())));
  AtomicFile file(directory / "a");
  EXPECT_THROW(write(file, "text"), MachineError);
}

TEST(SourceLocation, NamesAsMuchAsIsKnown) {
  EXPECT_EQ(to_string({"a.pbrt", 3, 7}), "a.pbrt:3:7");
  EXPECT_EQ(to_string({"a.pbrt", 0, 0}), "a.pbrt");
  EXPECT_EQ(to_string({}), "");
}

TEST(ClosestWord, FindsTyposOnly) {
  const std::vector<std::string> words{"diffuse", "dielectric", "conductor"};
  EXPECT_EQ(closest_word("difuse", words), "diffuse");
  EXPECT_EQ(closest_word("dieletcric", words), "dielectric");
  EXPECT_EQ(closest_word("mirror", words), "");
}

TEST(ForTerminal, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(for_terminal("blau, größer\n\tβ 😀"), "blau, größer\n\tβ 😀");
  EXPECT_EQ(for_terminal("a\nb", false), "a\\u000ab");
  EXPECT_EQ(for_terminal("\x1b[31m\r\x7f"), "\\u001b[31m\\u000d\\u007f");
  EXPECT_EQ(for_terminal("\xc2\x9b"
                         "1m \xe2\x80\xae"),
            "\\u009b1m \\u202e");
  EXPECT_EQ(for_terminal("\xff\xc0\x80 \xed\xa0\x80 \xe2\x82"), "\\xff\\xc0\\x80 \\xed\\xa0\\x80 \\xe2\\x82");
}

TEST(RegularFile, IsNoPipeAndNoDevice) {
  const test::TemporaryDirectory directory;
  ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(RegularFile(directory / "pipe"), Error);
  EXPECT_THROW(RegularFile("/dev/zero"), Error);
  EXPECT_THROW(RegularFile(directory.path()), Error);
  EXPECT_FALSE(RegularFile(directory / "none").is_open());
  std::ofstream(directory / "a") << "abc";
  std::array<std::byte, 2> bytes{};
  EXPECT_TRUE(RegularFile(directory / "a").read(bytes, 1));
  EXPECT_EQ(bytes[1], std::byte{'c'});
  EXPECT_FALSE(RegularFile(directory / "a").read(bytes, 2));
}

// What git leaves of large files where Git LFS is not installed.
TEST(RegularFile, IsNoPointerOfGitLfs) {
  const test::TemporaryDirectory directory;
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";
  std::ofstream(directory / "a.png") << pointer;
  try {
    const RegularFile file(directory / "a.png");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("git lfs pull"), std::string::npos) << error.what();
  }
  std::ofstream(directory / "b") << pointer << std::string(1024, ' ');
  EXPECT_TRUE(RegularFile(directory / "b").is_open());
}

}  // namespace
}  // namespace vitrail::files_and_messages_test
