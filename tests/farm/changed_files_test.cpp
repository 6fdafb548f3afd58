// SPDX-License-Identifier: Apache-2.0
// Files of a bundle that are changed while they are rendered.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "film/film_progress.h"
#include "tests/support/background.h"
#include "tests/support/partitioned_box.h"

namespace vitrail::test {
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
  EXPECT_TRUE(ended.status == 3 || ended.status == 4) << ended.status;
  EXPECT_THAT(ended.output, ::testing::AnyOf(HasSubstr("became shorter"), HasSubstr("this file changed")));
  EXPECT_FALSE(fs::exists(path("a.film")));
}

}  // namespace
}  // namespace vitrail::test
