// SPDX-License-Identifier: Apache-2.0
#include "farm/files/film_keeper.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

#include "farm/files/signals.h"
#include "scene/system/diagnostics.h"
#include "tests/farm/machine_limits.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::film_keeper_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

Film film_of(std::uint64_t seed) {
  FilmSettings settings;
  settings.width = settings.height = 64;
  settings.crop = {0, 64, 0, 64};
  Film film(settings, {.scene_hash = 1, .seed = seed});
  for (std::uint32_t pixel = 0; pixel < film.pixels(); ++pixel) {
    film.deposit(pixel, 0, {1, 2.0 + pixel, 3});
    film.count_sample(pixel, 0);
  }
  return film;
}

double seconds_of(const std::function<void()>& act) {
  const auto start = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// An empty disk of its own for this process, which has to be one of its own too. False without the right to.
bool mount_disk(const fs::path& folder, std::uint64_t bytes) {
  return ::unshare(CLONE_NEWNS) == 0 && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", folder.c_str(), "tmpfs", 0, fmt::format("size={}", bytes).c_str()) == 0;
}

bool can_mount() {
  const TemporaryDirectory folder;
  return wait_for(start_child([&] { ::_exit(mount_disk(folder.path(), 1 << 20) ? 0 : 1); })) == 0;
}

// As others do who know nothing of the job. Gives the bytes.
std::uint64_t fill_disk(const fs::path& folder) {
  const int file = ::open((folder / "other").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const std::vector<char> page(4096, 'x');
  std::uint64_t bytes = 0;
  for (ssize_t n = 0; (n = ::write(file, page.data(), page.size())) > 0;)
    bytes += static_cast<std::uint64_t>(n);
  ::close(file);
  return bytes;
}

class TheFilmKeeper : public ::testing::Test {
 protected:
  TheFilmKeeper() {
    for (const fs::path& folder : {spare_, temporary_, disk_}) fs::create_directory(folder);
    write_film(folder_ / "measured", film_, {});
    bytes_ = fs::file_size(folder_ / "measured");
    fs::remove(folder_ / "measured");
  }
  static std::uint64_t hash_of(const fs::path& file) { return read_film(file, nullptr).hash(); }
  // What write_last says, where its film is not in its place; "" where it is.
  std::string last(FilmKeeper& keeper, const fs::path& file) const {
    try {
      keeper.write_last(file, film_, {});
    } catch (const MachineError& elsewhere) {
      return elsewhere.what();
    }
    return {};
  }
  // Where it cannot be in its place, and a signal wants an end.
  std::string last_without_its_folder() const {
    FilmKeeper keeper(folder_ / "a.film", bytes_);
    ask_to_stop();
    return last(keeper, missing_);
  }

  const TemporaryDirectory folder_;
  const fs::path file_ = folder_ / "a.film", missing_ = folder_ / "missing" / "a.film";
  const fs::path spare_ = folder_ / "spare", temporary_ = folder_ / "temporary", disk_ = folder_ / "disk";
  const Film film_ = film_of(1);
  std::uint64_t bytes_ = 0;
};

TEST_F(TheFilmKeeper, WritesEachFilmInItsPlace) {
  FilmKeeper keeper(file_, bytes_);
  const Film before = film_of(2);
  EXPECT_TRUE(keeper.write_checkpoint(folder_ / "a.film.partial", before, {}));
  EXPECT_TRUE(keeper.write_checkpoint(folder_ / "a.film.partial", film_, {}));
  EXPECT_EQ(hash_of(folder_ / "a.film.partial"), film_.hash()) << "the last counts";
  keeper.write_last(file_, film_, {});
  EXPECT_EQ(hash_of(file_), film_.hash());
  EXPECT_GT(keeper.time_to_write_s(), 0);
}

TEST_F(TheFilmKeeper, LeavesNothingBesideTheFilm) {
  { const FilmKeeper keeper(file_, bytes_); }
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    EXPECT_TRUE(entry.is_directory()) << entry.path();
}

TEST_F(TheFilmKeeper, KnowsBeforehandWhereThereIsNoRoom) {
  EXPECT_THROW(FilmKeeper(missing_, bytes_), MachineError);
  EXPECT_THROW(FilmKeeper(file_, std::uint64_t{1} << 60), MachineError);
  const LimitedFiles full(bytes_ - 1);
  EXPECT_THROW(FilmKeeper(file_, bytes_), MachineError);
}

TEST_F(TheFilmKeeper, ACheckpointThatFailsLeavesTheLastOne) {
  FilmKeeper keeper(file_, bytes_);
  ASSERT_TRUE(keeper.write_checkpoint(file_, film_, {}));
  const Film more = film_of(2);
  {
    const LimitedFiles full(bytes_ / 2);
    ::testing::internal::CaptureStderr();
    EXPECT_FALSE(keeper.write_checkpoint(file_, more, {}));
    EXPECT_THAT(::testing::internal::GetCapturedStderr(),
                AllOf(HasSubstr("no checkpoint: "), HasSubstr(file_.string()), HasSubstr("tries again")));
  }
  EXPECT_EQ(hash_of(file_), film_.hash());
  EXPECT_TRUE(keeper.write_checkpoint(file_, more, {}));
  EXPECT_EQ(hash_of(file_), more.hash());
}

TEST_F(TheFilmKeeper, TriesTheLastAgain) {
  FilmKeeper keeper(file_, bytes_);
  std::thread helper([&] {
    std::this_thread::sleep_for(200ms);
    fs::create_directory(missing_.parent_path());
  });
  EXPECT_GT(seconds_of([&] { EXPECT_EQ(last(keeper, missing_), ""); }), .9);
  helper.join();
  EXPECT_EQ(hash_of(missing_), film_.hash());
}

TEST_F(TheFilmKeeper, TriesTwiceAndGoesElsewhere) {
  in_child([&] {
    fs::current_path(spare_);
    FilmKeeper keeper(file_, bytes_);
    EXPECT_GT(seconds_of([&] { EXPECT_THAT(last(keeper, missing_), HasSubstr("spare/a.film")); }), 4.9);
  });
  EXPECT_EQ(hash_of(spare_ / "a.film"), film_.hash());
}

TEST_F(TheFilmKeeper, GoesElsewhereAtOnceWhereASignalWantsAnEnd) {
  in_child([&] {
    fs::current_path(spare_);
    const Variable variable("TMPDIR", temporary_.c_str());
    ::testing::internal::CaptureStderr();
    EXPECT_THAT(last_without_its_folder(),
                AllOf(HasSubstr("the rendered samples are in " + (fs::canonical(spare_) / "a.film").string()),
                      HasSubstr("move that file to " + missing_.string())));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "it is not tried again";
  });
  EXPECT_EQ(hash_of(spare_ / "a.film"), film_.hash());
  EXPECT_TRUE(fs::is_empty(temporary_));
}

TEST_F(TheFilmKeeper, TakesANameThatIsFree) {
  for (const char* name : {"a.film", "a.film.2"}) std::ofstream(spare_ / name) << "another's";
  in_child([&] {
    fs::current_path(spare_);
    EXPECT_THAT(last_without_its_folder(), HasSubstr("a.film.3"));
  });
  EXPECT_EQ(hash_of(spare_ / "a.film.3"), film_.hash());
  for (const char* name : {"a.film", "a.film.2"}) EXPECT_EQ(fs::file_size(spare_ / name), 9u);
}

TEST_F(TheFilmKeeper, GoesToTMPDIRWhereThereIsNoCurrentFolder) {
  const Variable variable("TMPDIR", temporary_.c_str());
  in_child([&] {
    fs::current_path(spare_);
    fs::remove(spare_);
    EXPECT_THAT(last_without_its_folder(), HasSubstr((temporary_ / "a.film").string()));
  });
  EXPECT_EQ(hash_of(temporary_ / "a.film"), film_.hash());
}

TEST_F(TheFilmKeeper, SaysWhereNoFolderTakesIt) {
  in_child([&] {
    fs::current_path(spare_);
    FilmKeeper keeper(file_, bytes_);
    const LimitedFiles full(bytes_ / 2);
    ask_to_stop();
    EXPECT_THAT(last(keeper, file_), AllOf(HasSubstr(file_.string()), HasSubstr("are lost")));
  });
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_TRUE(fs::is_empty(spare_));
}

TEST_F(TheFilmKeeper, KeepsTheRoomOfAFilm) {
  if (!can_mount()) GTEST_SKIP() << "no right to mount a disk";
  in_child([&] {
    ASSERT_TRUE(mount_disk(disk_, 2 * bytes_));
    FilmKeeper keeper(disk_ / "a.film", bytes_);
    EXPECT_LE(fill_disk(disk_), bytes_);
    keeper.write_last(disk_ / "a.film", film_, {});
    EXPECT_EQ(hash_of(disk_ / "a.film"), film_.hash());
  });
}

// The checkpoint is on the disk, and both do not fit.
TEST_F(TheFilmKeeper, SaysThatTheNextFilmHasNoRoom) {
  if (!can_mount()) GTEST_SKIP() << "no right to mount a disk";
  in_child([&] {
    ASSERT_TRUE(mount_disk(disk_, 3 * bytes_ / 2));
    FilmKeeper keeper(disk_ / "a.film", bytes_);
    ::testing::internal::CaptureStderr();
    EXPECT_TRUE(keeper.write_checkpoint(disk_ / "a.film.partial", film_, {}));
    EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("no room for another film"));
    ::testing::internal::CaptureStderr();
    EXPECT_FALSE(keeper.write_checkpoint(disk_ / "a.film.partial", film_of(2), {}));
    EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("No space left"));
    EXPECT_EQ(hash_of(disk_ / "a.film.partial"), film_.hash());
  });
}

}  // namespace
}  // namespace vitrail::test::film_keeper_test
