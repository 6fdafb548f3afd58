// SPDX-License-Identifier: Apache-2.0
// A film in files has the sums of one in memory, and takes no more memory than its window.
#include "film/film_scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "film/film_progress.h"
#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace {

// What the disk takes long to free.
constexpr std::size_t slow_bytes = 37 * 4096;
constexpr std::chrono::milliseconds slow{1000};
std::atomic<bool> is_freed = false;

}  // namespace

extern "C" int munmap(void* at, std::size_t bytes) {
  if (bytes == slow_bytes) std::this_thread::sleep_for(slow);
  const int result = static_cast<int>(::syscall(SYS_munmap, at, bytes));
  if (bytes == slow_bytes) is_freed = true;
  return result;
}

namespace vitrail::film_scratch_test {
namespace {

constexpr std::uint64_t mib = 1 << 20, window = FilmScratch::least_window_bytes;

// Of pages of files that are mapped here, as the kernel counts them.
std::uint64_t mapped_bytes() {
  std::ifstream status("/proc/self/status");
  std::uint64_t kib = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("RssFile:") || line.starts_with("RssShmem:"))
      kib += std::stoull(line.substr(line.find(':') + 1));
  return kib << 10;
}

FilmSettings settings() {
  FilmSettings s{.width = 640, .height = 200, .crop = {0, 640, 0, 200}};
  s.spectrum = {16, 400, 700};
  s.layers.add(Layer::depth);
  s.layers.add(Layer::shape);
  s.layers.add(Layer::crypto_object);
  return s;
}

Film film_of(std::shared_ptr<FilmScratch> scratch) {
  return Film(settings(), {11, 33, 7}, default_exponent, default_exponent, std::move(scratch));
}

// Pixels far from each other, one after the other.
void deposit_all(Film& film, std::uint32_t first, std::uint32_t step, std::uint64_t* most_mapped = nullptr) {
  const std::uint32_t pixels = film.pixels();
  for (std::uint32_t i = first; i < pixels; i += step) {
    const auto p = static_cast<std::uint32_t>(std::uint64_t{i} * 40'503 % pixels);
    film.count_sample(p, i);
    film.deposit(p, i, {0.001 * i, 0.7, 0.3 * (i % 5)});
    film.deposit_bin(p, i, i % 16, 0.5 * (i % 9));
    film.deposit_layer(p, i, Layer::depth, std::array{0.3 * (i % 7)});
    film.put_id(p, i, Layer::shape, i % 1000);
    film.put_matte(p, Layer::crypto_object, 1 + i % 6, 1);
    if (most_mapped && i % 64 == 0) *most_mapped = std::max(*most_mapped, mapped_bytes());
  }
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FilmInFiles : public testing::Test {
 protected:
  FilmInFiles() { deposit_all(in_memory_, 0, 1); }
  Film in_memory_ = film_of(nullptr);
  test::TemporaryDirectory directory_;
  const FilmProgress progress_{1, 2, {1}, 0, {}, "", false, {}};
};

TEST_F(FilmInFiles, HasTheSumsOfOneInMemoryAndMapsNoMoreThanItsWindow) {
  const std::uint64_t before = mapped_bytes();
  Film film = film_of(std::make_shared<FilmScratch>(window));
  EXPECT_GT(film.scratch()->file_bytes(), 3 * window) << "or the test shows nothing";
  constexpr std::uint32_t threads = 4;
  std::array<std::uint64_t, threads> most{};
  {
    std::vector<std::jthread> all;
    for (std::uint32_t t = 0; t < threads; ++t)
      all.emplace_back([&, t] { deposit_all(film, t, threads, &most[t]); });
  }
  EXPECT_LE(std::ranges::max(most), before + window + mib / 4);
  EXPECT_EQ(film.hash(), in_memory_.hash());
  EXPECT_EQ(film.samples(), in_memory_.samples());
  for (const std::uint32_t p : {0u, 1u, 33'333u, film.pixels() - 1}) {
    EXPECT_EQ(film.mean(p).y, in_memory_.mean(p).y);
    EXPECT_EQ(film.variance_of_mean(p), in_memory_.variance_of_mean(p));
    EXPECT_EQ(film.id(p, Layer::shape), in_memory_.id(p, Layer::shape));
    EXPECT_EQ(film.matte(p, Layer::crypto_object), in_memory_.matte(p, Layer::crypto_object));
  }
  EXPECT_LE(mapped_bytes(), before + window + mib / 4);
}

TEST_F(FilmInFiles, IsReadAndWrittenAsTheSameFile) {
  const std::filesystem::path a = directory_ / "a.film", b = directory_ / "b.film";
  write_film(a, in_memory_, progress_);
  const std::uint64_t before = mapped_bytes();
  const Film film = read_film(a, nullptr, std::make_shared<FilmScratch>(window));
  EXPECT_EQ(film.hash(), in_memory_.hash());
  write_film(b, film, progress_);
  EXPECT_TRUE(bytes_of(a) == bytes_of(b));
  EXPECT_LE(mapped_bytes(), before + mib) << "what is gone through leaves";
}

TEST_F(FilmInFiles, MovesToWhereItIsAssigned) {
  const auto scratch = std::make_shared<FilmScratch>(window);
  Film film = film_of(scratch);
  Film filled = film_of(scratch);
  filled.merge(in_memory_);
  film = std::move(filled);
  EXPECT_EQ(film.scratch(), scratch);
  deposit_all(film, 0, 1);
  in_memory_.merge(Film(in_memory_));
  EXPECT_EQ(film.samples(), in_memory_.samples());
  EXPECT_EQ(film.mean(5).y, in_memory_.mean(5).y);
}

// Of pages that had to be read from a disk.
long major_faults() {
  rusage usage;
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_majflt;
}

// Has the system write the pages to their file and forget them.
void forget(void* at, std::size_t bytes) {
  ::msync(at, bytes, MS_SYNC);
  ::madvise(at, bytes, MADV_PAGEOUT);
}

std::uint64_t pages_in_memory(void* at, std::size_t bytes) {
  std::vector<unsigned char> pages(bytes / static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
  ::mincore(at, bytes, pages.data());
  return static_cast<std::uint64_t>(std::ranges::count_if(pages, [](unsigned char p) { return p & 1; }));
}

TEST(FilmScratch, APassInOrderDoesNotWaitForPageByPage) {
  constexpr std::size_t bytes = 24 * mib, count = bytes / sizeof(std::uint64_t);
  FilmScratch scratch(window);
  const std::span all(static_cast<std::uint64_t*>(scratch.allocate(bytes)), count);
  std::iota(all.begin(), all.end(), std::uint64_t{1});
  forget(all.data(), bytes);
  const std::uint64_t pages = bytes / static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  if (pages_in_memory(all.data(), bytes) > pages / 16)
    GTEST_SKIP() << "the system keeps the pages: the folder for temporary files is in memory";
  std::uint64_t sum = 0;
  const long before = major_faults();
  in_parts(all, &scratch, [&](auto part) { sum = std::accumulate(part.begin(), part.end(), sum); });
  EXPECT_LT(major_faults() - before, static_cast<long>(pages / 16));
  EXPECT_EQ(sum, std::uint64_t{count} * (count + 1) / 2);
  scratch.deallocate(all.data(), bytes);
}

TEST(FilmScratch, WithoutAFolderSaysWhatToDo) {
  const char* const named = std::getenv("TMPDIR");
  const std::string before = named ? named : "";
  ::setenv("TMPDIR", "/nowhere/at/all", 1);
  try {
    film_of(std::make_shared<FilmScratch>(window));
    ADD_FAILURE() << "no error";
  } catch (const MachineError& e) {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("/nowhere/at/all"), testing::HasSubstr("TMPDIR"),
                                         testing::HasSubstr("--memory")));
  }
  named ? ::setenv("TMPDIR", before.c_str(), 1) : ::unsetenv("TMPDIR");
}

TEST_F(FilmInFiles, NobodyWaitsForADiskThatFreesSlowly) {
  FilmScratch scratch(window);
  void* const at = scratch.allocate(slow_bytes);
  const auto begun = std::chrono::steady_clock::now();
  scratch.deallocate(at, slow_bytes);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, slow / 2);
  while (!is_freed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace
}  // namespace vitrail::film_scratch_test
