// SPDX-License-Identifier: Apache-2.0
#include "scene/system/memory_guard.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <list>
#include <memory>
#include <vector>

#include "scene/system/resource_usage.h"

// A sanitizer keeps its own `new`.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace vitrail {
namespace {

constexpr std::uint64_t mib = 1 << 20;

// What `body` ends with, in a process of its own: the guard cannot be put off.
template <class Body>
[[noreturn]] void end_with(std::uint64_t allowed, Body body) {
  const std::uint64_t budget = resident_bytes() + allowed;
  guard_memory(budget);
  int status = 0;
  try {
    body();
  } catch (const MemoryRefused&) {
    status = 1;
  }
  const MemoryRefusal refusal = memory_refusal();
  if (refusal.refused != (status == 1)) status = 2;
  if (peak_resident_bytes() > budget) status = 3;
  std::_Exit(status);
}

TEST(MemoryGuardDeathTest, RefusesOneLargeBlock) {
  EXPECT_EXIT(end_with(32 * mib, [] { std::vector<char> filled(64 * mib, 'a'); }),
              ::testing::ExitedWithCode(1), "");
}

TEST(MemoryGuardDeathTest, RefusesManySmallBlocks) {
  EXPECT_EXIT(end_with(32 * mib,
                       [] {
                         std::list<int> many;
                         for (int i = 0; i < 2'000'000; ++i) many.push_back(i);
                       }),
              ::testing::ExitedWithCode(1), "");
}

// The first is promised when the second is asked for.
TEST(MemoryGuardDeathTest, RemembersWhatItPromised) {
  EXPECT_EXIT(end_with(64 * mib,
                       [] {
                         const auto later = std::make_unique_for_overwrite<char[]>(40 * mib);
                         *static_cast<volatile char*>(later.get()) = 'a';  // or it is left out
                         ask_memory(40 * mib);
                       }),
              ::testing::ExitedWithCode(1), "");
}

TEST(MemoryGuardDeathTest, FreedBlocksMayBeTakenAgain) {
  EXPECT_EXIT(end_with(64 * mib,
                       [] {
                         for (int round = 0; round < 4; ++round) {
                           std::vector<std::unique_ptr<char[]>> blocks;
                           for (int i = 0; i < 400; ++i) blocks.push_back(std::make_unique<char[]>(100'000));
                         }
                         std::vector<char> filled(48 * mib, 'a');
                       }),
              ::testing::ExitedWithCode(0), "");
}

TEST(MemoryGuard, AllowsAllWhereNothingIsPromised) {
  EXPECT_TRUE(memory_allows(std::uint64_t{1} << 60));
  EXPECT_NO_THROW(ask_memory(std::uint64_t{1} << 60));
  EXPECT_FALSE(memory_refusal().refused);
}

}  // namespace
}  // namespace vitrail

#endif
