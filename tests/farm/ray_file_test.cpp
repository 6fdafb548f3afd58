// SPDX-License-Identifier: Apache-2.0
#include "farm/rays/ray_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <random>
#include <set>
#include <vector>

#include "scene/system/diagnostics.h"
#include "scene/system/scratch_file.h"
#include "tests/farm/machine_limits.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::ray_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

RayBatch batch_of(std::uint32_t first, std::size_t rays, std::uint32_t domain = 0) {
  RayBatch batch(domain, RayKind::path);
  for (std::uint32_t i = 0; i < rays; ++i) {
    RayRecord path{};
    path.path.sample.pixel = first + i;
    batch.append(path);
  }
  return batch;
}

RayBatch full_batch(std::uint32_t first) {
  RayBatch batch = batch_of(first, (RayBatch::full_bytes - RayBatch::header_bytes) / sizeof(RayRecord));
  EXPECT_TRUE(batch.full());
  return batch;
}

class TheRayFile : public ::testing::Test {
 protected:
  // Of the file without a name in the folder; −1 where there is none.
  int descriptor() const {
    for (const auto& open : fs::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      if (fs::read_symlink(open.path(), gone).string().starts_with(folder_.path().string() + "/"))
        return std::stoi(open.path().filename());
    }
    return -1;
  }
  // Why it cannot be written; "" where it can.
  static std::string failure(RayFile& file, const RayBatch& batch) {
    try {
      file.write(batch);
    } catch (const MachineError& failed) {
      return failed.what();
    }
    return {};
  }

  const TemporaryDirectory folder_;
  const Variable scratch_{"TMPDIR", folder_.path().c_str()};
};

TEST_F(TheRayFile, GivesBackWhatItTook) {
  RayFile file;
  std::vector<std::pair<RayFile::Place, RayBatch>> kept;
  std::uint64_t bytes = 0;
  const auto keep = [&](const RayBatch& batch) {
    kept.emplace_back(file.write(batch), batch);
    EXPECT_EQ(kept.back().first.bytes, batch.bytes().size());
    bytes += batch.bytes().size();
    EXPECT_EQ(file.written_bytes(), bytes);
  };
  keep(RayBatch());
  keep(batch_of(0, 0, 7));
  keep(full_batch(1));
  keep(batch_of(2000, 1, 3));
  keep(full_batch(3000));
  for (const std::size_t i : {2u, 0u, 4u, 1u, 3u})
    EXPECT_EQ(file.read(kept[i].first).bytes(), kept[i].second.bytes()) << i;
  EXPECT_EQ(file.written_bytes(), bytes) << "reading is no writing";
}

TEST_F(TheRayFile, UsesRoomAgain) {
  RayFile file;
  constexpr std::uint32_t most = 3;
  std::vector<std::pair<RayFile::Place, std::uint32_t>> kept;
  for (std::uint32_t i = 0; i < 100; ++i) {
    if (kept.size() == most) {
      const auto [place, first] = kept[i % most];
      kept.erase(kept.begin() + i % most);
      EXPECT_EQ(file.read(place).bytes(), full_batch(first).bytes());
    }
    kept.emplace_back(file.write(full_batch(1000 * i)), 1000 * i);
    std::set<std::uint32_t> slots;
    for (const auto& [place, first] : kept) slots.insert(place.unit);
    EXPECT_EQ(slots.size(), kept.size()) << "two in one place";
    EXPECT_LT(*slots.rbegin(), most * FileRoom::slab_units);
  }
}

// As long as what it holds at the most, and a unit a batch.
TEST_F(TheRayFile, TakesNoMoreRoomThanItsBatches) {
  RayFile file;
  std::mt19937 random(1);
  std::vector<std::pair<RayFile::Place, RayBatch>> kept;
  std::uint64_t held = 0, most = 0;
  for (int i = 0; i < 4000; ++i) {
    if (kept.size() > 500 || (kept.size() > 10 && random() % 3 == 0)) {
      std::swap(kept[random() % kept.size()], kept.back());
      const auto [place, batch] = kept.back();
      ASSERT_EQ(file.read(place).bytes(), batch.bytes());
      held -= place.bytes;
      kept.pop_back();
    }
    const RayBatch batch = batch_of(static_cast<std::uint32_t>(i), 1 + random() % 20);
    kept.emplace_back(file.write(batch), batch);
    held += batch.bytes().size();
    most = std::max(most, held);
  }
  struct stat status {};
  ASSERT_EQ(::fstat(descriptor(), &status), 0);
  EXPECT_LT(static_cast<std::uint64_t>(status.st_size), most + most / 2 + 500 * FileRoom::unit_bytes);
  for (const auto& [place, batch] : kept) ASSERT_EQ(file.read(place).bytes(), batch.bytes());
}

TEST_F(TheRayFile, IsMadeWithTheFirstBatch) {
  RayFile file;
  EXPECT_EQ(descriptor(), -1);
  EXPECT_EQ(file.written_bytes(), 0u);
  file.write(batch_of(0, 1));
  EXPECT_GE(descriptor(), 0);
}

TEST_F(TheRayFile, HasNoNameAndGoesWithItsOwner) {
  {
    RayFile file;
    file.write(full_batch(0));
    EXPECT_TRUE(fs::is_empty(folder_.path()));
  }
  EXPECT_EQ(descriptor(), -1);
  const int status = wait_for(start_child([] {
    RayFile file;
    file.write(full_batch(0));
    ::raise(SIGKILL);
  }));
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(TheRayFile, SaysWhereTheDiskIsFull) {
  RayFile file;
  const RayBatch first = full_batch(0), second = full_batch(5000);
  const RayFile::Place place = file.write(first);
  {
    const LimitedFiles full(RayBatch::full_bytes + 100);  // a part of the second fits
    const std::string why = failure(file, second);
    EXPECT_THAT(why, HasSubstr("cannot be written in " + folder_.path().string()));
    EXPECT_THAT(why, HasSubstr("TMPDIR"));
    EXPECT_EQ(file.written_bytes(), first.bytes().size());
  }
  EXPECT_EQ(file.read(place).bytes(), first.bytes());
  EXPECT_EQ(file.read(file.write(second)).bytes(), second.bytes());
}

TEST_F(TheRayFile, SaysWhereTheDiskLostThem) {
  RayFile file;
  const RayFile::Place place = file.write(full_batch(0));
  ASSERT_EQ(::ftruncate(descriptor(), 100), 0);
  EXPECT_THROW(file.read(place), MachineError);
}

TEST_F(TheRayFile, NeedsItsFolder) {
  const std::string missing = (folder_ / "missing").string();
  const Variable nowhere("TMPDIR", missing.c_str());
  RayFile file;
  EXPECT_THAT(failure(file, batch_of(0, 1)), HasSubstr("cannot be kept in " + missing));
  fs::create_directory(missing);
  EXPECT_EQ(failure(file, batch_of(0, 1)), "");
}

TEST(ScratchDirectory, IsOnADiskUnlessChosen) {
  for (const char* chosen : {"/somewhere", "/var/tmp", "", static_cast<const char*>(nullptr)}) {
    const Variable variable("TMPDIR", chosen);
    EXPECT_EQ(scratch_directory(), chosen && *chosen ? chosen : "/var/tmp");
  }
}

}  // namespace
}  // namespace vitrail::test::ray_file_test
