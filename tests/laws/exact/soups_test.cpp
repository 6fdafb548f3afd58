// SPDX-License-Identifier: Apache-2.0
// The first two laws, for soups of degenerate triangles: thousands of them here, with VITRAIL_LONG_TESTS
// 10,000, VITRAIL_SOUPS=1000000 or however many; VITRAIL_SOUP=seed judges one and says what differs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdlib>
#include <ctime>

#include "tests/laws/exact/soup_laws.h"
#include "tests/support/long_tests.h"

namespace vitrail::test::soups_test {
namespace {

Findings judge_all(std::uint64_t begin, std::uint64_t end, const Effort& effort) {
  tbb::enumerable_thread_specific<Findings> parts;
  tbb::parallel_for(tbb::blocked_range<std::uint64_t>(begin, end, 16), [&](const auto& range) {
    Findings& mine = parts.local();
    // What partitioning waits for is its own work only, not another soup.
    tbb::this_task_arena::isolate([&] {
      for (std::uint64_t seed = range.begin(); seed != range.end(); ++seed)
        judge(soup_of(seed), effort, mine);
    });
  });
  Findings all;
  for (const Findings& part : parts) all.add(part);
  return all;
}

std::uint64_t number_in(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(Soups, KeepTheLaws) {
  constexpr std::uint64_t step = 50'000;
  const std::uint64_t soups = number_in("VITRAIL_SOUPS", of_all(10'000u, 2'500u)),
                      begin = number_in("VITRAIL_FIRST_SOUP", 0);
  const auto start = std::chrono::steady_clock::now();
  Findings all;
  for (std::uint64_t at = begin; at < begin + soups; at += step) {
    all.add(judge_all(at, std::min(at + step, begin + soups), {}));
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    fmt::print("{}{:<20}{:>14.1f}\n{:<20}{:>14.1f}\n\n", all.table(), "seconds", wall.count(),
               "of processors", static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
    std::fflush(stdout);
  }
  EXPECT_TRUE(all.differences.empty()) << all.table();
  EXPECT_EQ(all.soups, soups);
  EXPECT_GT(all.pieces, all.soups);
  EXPECT_GT(all.hits, all.rays / 4);
  EXPECT_GT(all.visits, all.rays);
  EXPECT_GT(all.oracle_rays, all.soups / 8);
  EXPECT_GT(all.by_files, all.soups / 200);
  EXPECT_GT(all.instances, all.by_files);
}

TEST(Soups, One) {
  const char* seed = std::getenv("VITRAIL_SOUP");
  if (!seed) GTEST_SKIP() << "VITRAIL_SOUP names no seed";
  const Soup soup = soup_of(std::strtoull(seed, nullptr, 10));
  fmt::print("{} triangles, {} domains{}, reach {}\n", soup.triangles.size(), soup.domains,
             soup.any_planes ? " at any planes" : "", soup.reach);
  Findings findings;
  judge(soup, {.verbose = true}, findings);
  EXPECT_TRUE(findings.differences.empty()) << findings.table();
}

}  // namespace
}  // namespace vitrail::test::soups_test
