// SPDX-License-Identifier: Apache-2.0
// Files of a bundle that are changed while they are rendered.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <map>

#include "bundle/watched_files.h"
#include "farm/files/crashes.h"
#include "film/film_progress.h"
#include "tests/farm/machine_limits.h"
#include "tests/support/background.h"
#include "tests/support/partitioned_box.h"
#include "tests/support/paths.h"

namespace vitrail::test::changed_files_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

class ChangedFiles : public PartitionedBox {
 protected:
  ChangedFiles() : PartitionedBox(4) {}
  std::string line(const std::string& out) const {
    return fmt::format("{} '{}' -o '{}' --crop 0,64,0,64 --spp 256 --threads 1 --checkpoint-every .1 --quiet",
                       vitrail("render"), path("box.vit"), path(out));
  }
  void change_all(const std::function<void(const fs::path&)>& change) const {
    for (const auto& file : fs::directory_iterator(path("box.vit/domains"))) change(file.path());
  }
  // Renders, and changes every domain once all of them are mapped.
  CommandResult rendered_while(const std::function<void(const fs::path&)>& change) const {
    std::string command = line("a.film");
    std::erase(command, '\'');
    CommandResult result;
    {
      Background job(fmt::format("sh -c '{} 2>{}'", command, path("said")));
      while (job.running() && !fs::exists(path("a.film.partial"))) std::this_thread::sleep_for(5ms);
      EXPECT_TRUE(job.running());
      change_all(change);
      result.status = job.wait();
    }
    std::ifstream said(path("said"));
    result.output.assign(std::istreambuf_iterator<char>(said), {});
    return result;
  }
  // How often a render opens each file of domains. A file server answers each call that has a name: a load
  // makes one. Whoever looks for changes asks later. Empty where there is no strace.
  std::map<std::string, int> opens() const {
    std::map<std::string, int> opened;
    const std::string strace =
        fmt::format("strace -f -qq -s 256 -o '{}' -e trace=openat,?stat,newfstatat,statx ", path("calls"));
    if (run(strace + "true").status != 0) return opened;
    const CommandResult made = run(strace + fmt::format("{} '{}' -o '{}' --spp 1 --threads 1 --quiet",
                                                        vitrail("render"), path("box.vit"), path("a.film")));
    EXPECT_EQ(made.status, 0) << made.output;
    std::ifstream calls(path("calls"));
    for (std::string call; std::getline(calls, call);) {
      const auto at = call.find("domains/");
      if (at == std::string::npos) continue;
      const std::string file = call.substr(at, call.find('"', at) - at);
      if (call.find("openat(") < at) ++opened[file];
      EXPECT_TRUE(opened.contains(file)) << call;
    }
    return opened;
  }
};

TEST_F(ChangedFiles, ChangedInPlaceEndsTheJob) {
  ASSERT_EQ(run(line("whole.film")).status, 0);
  fs::copy(path("box.vit"), path("kept.vit"), fs::copy_options::recursive);
  const CommandResult ended = rendered_while([](const fs::path& file) {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(-64, std::ios::end);
    bytes << '?';
  });
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr(".dom: this file changed during the render"));
  EXPECT_FALSE(fs::exists(path("a.film")));
  // The checkpoint is of before.
  fs::remove_all(path("box.vit"));
  fs::rename(path("kept.vit"), path("box.vit"));
  ASSERT_EQ(run(line("a.film")).status, 0);
  EXPECT_EQ(read_film(path("a.film"), nullptr).hash(), read_film(path("whole.film"), nullptr).hash());
}

TEST_F(ChangedFiles, DeletedOrReplacedWhileMappedIsAsItWas) {
  ASSERT_EQ(run(line("whole.film")).status, 0);
  const CommandResult replaced = rendered_while([](const fs::path& file) {
    std::ofstream(file.string() + ".new") << "something else";
    fs::rename(file.string() + ".new", file);
  });
  EXPECT_EQ(replaced.status, 0) << replaced.output;
  EXPECT_EQ(read_film(path("a.film"), nullptr).hash(), read_film(path("whole.film"), nullptr).hash());
  const CommandResult refused = run(line("b.film"));
  EXPECT_EQ(refused.status, 3);
  change_all([](const fs::path& file) { fs::remove(file); });
  EXPECT_EQ(run(line("b.film")).status, 4);
}

TEST_F(ChangedFiles, CutShortEndsTheJob) {
  const CommandResult ended = rendered_while([](const fs::path& file) { fs::resize_file(file, 1); });
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr(".dom: this file changed during the render"));
  EXPECT_FALSE(fs::exists(path("a.film")));
}

TEST_F(ChangedFiles, AreOpenedOnceAndNotAskedForBefore) {
  const std::map<std::string, int> opened = opens();
  if (opened.empty()) GTEST_SKIP() << "there is no strace, or it may not trace";
  EXPECT_EQ(opened.size(), 4u);
  for (const auto& [file, times] : opened) EXPECT_EQ(times, 1) << file;
}

// The same box, its four domains in one pack.
class PackedFiles : public ChangedFiles {
 protected:
  void SetUp() override {
    ChangedFiles::SetUp();
    fs::rename(path("box.vit"), path("files.vit"));
    const CommandResult made =
        run(fmt::format("{} '{}/examples/cornell-box/cornell-box.pbrt' -o '{}' --domains 4 --pack 1G --quiet",
                        vitrail("partition"), source_dir(), path("box.vit")));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  CommandResult rendered(const std::string& bundle, const std::string& film) const {
    return run(fmt::format("{} '{}' -o '{}' --spp 1 --threads 1 --quiet --domain-memory 1",
                           mpi_vitrail("render", 2), path(bundle), path(film)));
  }
};

TEST_F(PackedFiles, MakeTheSameFilmOnTwoRanksInLittleMemory) {
  ASSERT_EQ(rendered("files.vit", "files.film").status, 0);
  const CommandResult packed = rendered("box.vit", "packed.film");
  ASSERT_EQ(packed.status, 0) << packed.output;
  EXPECT_EQ(read_film(path("packed.film"), nullptr).hash(), read_film(path("files.film"), nullptr).hash());
}

TEST_F(PackedFiles, AreOpenedOnce) {
  const std::map<std::string, int> opened = opens();
  if (opened.empty()) GTEST_SKIP() << "there is no strace, or it may not trace";
  EXPECT_EQ(opened, (std::map<std::string, int>{{"domains/pack-0000", 1}}));
}

TEST_F(PackedFiles, CutShortEndsTheJob) {
  const CommandResult ended = rendered_while([](const fs::path& file) { fs::resize_file(file, 1); });
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.output, HasSubstr("pack-0000: this file changed during the render"));
  EXPECT_FALSE(fs::exists(path("a.film")));
}

// A grid of 800 triangles, whose tree has nodes under nodes.
class OverwrittenFiles : public ChangedFiles {
 protected:
  void SetUp() override {
    std::ofstream scene(path("grid.pbrt"));
    scene << "LookAt 0 0 3  0 0 0  0 1 0 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 64 "
             "\"integer "
             "yresolution\" 64 WorldBegin LightSource \"infinite\" Shape \"trianglemesh\" \"point3 P\" [";
    constexpr int side = 20;
    for (int y = 0; y <= side; ++y)
      for (int x = 0; x <= side; ++x)
        scene << .1 * x - 1 << ' ' << .1 * y - 1 << ' ' << .01 * ((x * x + y) % 7) << ' ';
    scene << "] \"integer indices\" [";
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int p = y * (side + 1) + x;
        scene << p << ' ' << p + 1 << ' ' << p + side + 1 << ' ' << p + 1 << ' ' << p + side + 2 << ' '
              << p + side + 1 << ' ';
      }
    scene << "]";
    scene.close();
    const CommandResult made = run(fmt::format("{} '{}' -o '{}' --domains 2 --quiet", vitrail("partition"),
                                               path("grid.pbrt"), path("box.vit")));
    ASSERT_EQ(made.status, 0) << made.output;
  }
  void expect_named(char byte) const {
    const CommandResult ended = rendered_while([&](const fs::path& file) {
      const auto bytes = fs::file_size(file);
      std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
      out.seekp(512);
      out << std::string(bytes - 512, byte);
    });
    EXPECT_EQ(ended.status, 3) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(".dom: this file changed during the render"));
    EXPECT_FALSE(fs::exists(path("a.film")));
  }
};

// Every child is the root: a traversal has no end, and no checkpoint comes.
TEST_F(OverwrittenFiles, WithoutEndAreNamed) { expect_named('\0'); }

// Children are far outside of the file.
TEST_F(OverwrittenFiles, ThatCrashAreNamed) { expect_named('\x3f'); }

// Touches the second page of a mapped file of two that was cut; returns what it says and its exit status.
CommandResult touched_after(const fs::path& folder, const std::function<void(const fs::path&)>& change) {
  const fs::path file = folder / "two-pages", said = folder / "said";
  const auto page = static_cast<std::size_t>(::getpagesize());
  std::ofstream(file) << std::string(2 * page, 'x');
  CommandResult result;
  const int status = wait_for(start_child([&] {
    const int out = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600),
              in = ::open(file.c_str(), O_RDONLY);
    ::dup2(out, STDERR_FILENO);
    struct stat opened;
    ::fstat(in, &opened);
    watch(file, opened);
    const void* mapped = ::mmap(nullptr, 2 * page, PROT_READ, MAP_SHARED, in, 0);
    catch_crashes();
    change(file);
    [[maybe_unused]] const char touched = static_cast<const volatile char*>(mapped)[page];
  }));
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::ifstream words(said);
  result.output.assign(std::istreambuf_iterator<char>(words), {});
  return result;
}

TEST(Crashes, NameTheFileThatTheyAreOf) {
  const TemporaryDirectory directory;
  const CommandResult shorter =
      touched_after(directory.path(), [](const fs::path& file) { fs::resize_file(file, 1); });
  EXPECT_EQ(shorter.status, 3);
  EXPECT_THAT(shorter.output, HasSubstr("two-pages: this file changed during the render"));
  const CommandResult gone = touched_after(directory.path(), [](const fs::path& file) {
    fs::resize_file(file, 1);
    fs::remove(file);
  });
  EXPECT_EQ(gone.status, 4);
  EXPECT_THAT(gone.output, HasSubstr("cannot read " + (directory / "two-pages").string()));
}

TEST(Crashes, OfOtherReasonsAreAsBefore) {
  const TemporaryDirectory directory;
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS})
    EXPECT_EQ(touched_after(directory.path(), [&](const fs::path&) { ::raise(number); }).status,
              128 + number);
}

}  // namespace
}  // namespace vitrail::test::changed_files_test
