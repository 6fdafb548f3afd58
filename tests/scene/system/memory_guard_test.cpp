// SPDX-License-Identifier: Apache-2.0
#include "scene/system/memory_guard.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <future>
#include <list>
#include <memory>
#include <thread>
#include <vector>

#include "scene/system/resource_usage.h"

// A sanitizer keeps its own `new`.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace vitrail::memory_guard_test {
namespace {

constexpr std::uint64_t mib = 1 << 20;

// What `body` ends with, in a process of its own: the guard cannot be put off.
template <class Body>
[[noreturn]] void end_with(std::uint64_t allowed, Body body, bool (*is_own)() = nullptr) {
  const std::uint64_t budget = resident_bytes() + allowed;
  guard_memory(budget, is_own);
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

// Nobody has written to them when the next is taken.
TEST(MemoryGuardDeathTest, RemembersEachBlockThatIsNotFilled) {
  for (const int blocks : {2, 3, 5})
    EXPECT_EXIT(end_with(64 * mib,
                         [blocks] {
                           std::vector<std::vector<char>> reserved(blocks);
                           for (auto& block : reserved) block.reserve(80 * mib / blocks);
                           for (auto& block : reserved) block.assign(block.capacity(), 'a');
                         }),
                ::testing::ExitedWithCode(1), "")
        << blocks;
}

// A filled one is resident, in whatever order it was filled; a freed one is nothing.
TEST(MemoryGuardDeathTest, ForgetsBlocksThatAreFilledOrFreed) {
  EXPECT_EXIT(end_with(64 * mib,
                       [] {
                         for (int round = 0; round < 10; ++round) std::vector<char>().reserve(40 * mib);
                         std::vector<std::unique_ptr<char[]>> kept;
                         for (int i = 0; i < 5; ++i) {
                           kept.push_back(std::make_unique_for_overwrite<char[]>(10 * mib));
                           for (std::uint64_t at = 10 * mib; at > 0; at -= 4096)
                             static_cast<volatile char*>(kept.back().get())[at - 1] = 'a';
                         }
                       }),
              ::testing::ExitedWithCode(0), "");
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

// A library that no exception may pass: `noexcept` would end the process.
void fill_as_a_library(std::uint64_t bytes) noexcept { std::vector<char> filled(bytes, 'a'); }

TEST(MemoryGuardDeathTest, GrantsALibraryWhatWasAskedFor) {
  EXPECT_EXIT(end_with(32 * mib,
                       [] {
                         const GrantedMemory library(20 * mib);
                         fill_as_a_library(20 * mib);
                       }),
              ::testing::ExitedWithCode(0), "");
}

TEST(MemoryGuardDeathTest, RefusesALibraryBeforeItBegins) {
  EXPECT_EXIT(end_with(32 * mib,
                       [] {
                         const GrantedMemory library(64 * mib);
                         fill_as_a_library(64 * mib);
                       }),
              ::testing::ExitedWithCode(1), "");
}

// It took more than was asked for: our next block is refused, the library's was not.
TEST(MemoryGuardDeathTest, RefusesOursAfterALibraryThatTookMore) {
  EXPECT_EXIT(
      {
        guard_memory(resident_bytes() + 32 * mib);
        std::vector<char> kept;
        {
          const GrantedMemory library(mib);
          [&]() noexcept { kept.assign(64 * mib, 'a'); }();
        }
        try {
          ::operator delete(::operator new(1));  // called by its name, or it is left out
        } catch (const MemoryRefused&) {
          std::_Exit(1);
        }
        std::_Exit(0);
      },
      ::testing::ExitedWithCode(1), "");
}

TEST(MemoryGuardDeathTest, RefusesWhatALibraryCallsBack) {
  EXPECT_EXIT(end_with(32 * mib,
                       [] {
                         const GrantedMemory library;
                         const GuardedMemory ours;
                         std::vector<char> filled(64 * mib, 'a');
                       }),
              ::testing::ExitedWithCode(1), "");
}

struct TakesInItsDestructor {
  ~TakesInItsDestructor() { std::vector<char> filled(64 * mib, 'a'); }
};

// Within an exception's way a destructor that throws would end the process.
TEST(MemoryGuardDeathTest, GrantsDestructorsOfWhatIsRefused) {
  EXPECT_EXIT(
      {
        guard_memory(resident_bytes() + 32 * mib);
        try {
          const TakesInItsDestructor takes;
          throw 1;
        } catch (int) {
          std::_Exit(memory_refusal().refused ? 2 : 1);
        }
      },
      ::testing::ExitedWithCode(1), "");
}

// Nobody would catch what is thrown there.
TEST(MemoryGuardDeathTest, GrantsThreadsThatAreNotOurs) {
  EXPECT_EXIT(
      {
        guard_memory(resident_bytes() + 32 * mib, [] { return false; });
        std::thread([] { fill_as_a_library(64 * mib); }).join();
        std::_Exit(memory_refusal().refused ? 2 : 1);
      },
      ::testing::ExitedWithCode(1), "");
}

TEST(MemoryGuardDeathTest, RefusesThreadsThatAreOurs) {
  EXPECT_EXIT(
      end_with(
          32 * mib,
          [] { std::async(std::launch::async, [] { std::vector<char> filled(64 * mib, 'a'); }).get(); },
          [] { return true; }),
      ::testing::ExitedWithCode(1), "");
}

// What can do without is told so, and nothing counts as refused.
TEST(MemoryGuardDeathTest, RefusesWithoutThrowing) {
  EXPECT_EXIT(end_with(32 * mib,
                       [] {
                         if (::operator new(64 * mib, std::nothrow)) std::_Exit(4);
                         ::operator delete(::operator new(mib, std::nothrow));
                       }),
              ::testing::ExitedWithCode(0), "");
}

TEST(MemoryGuardDeathTest, EndsWithTheWork) {
  EXPECT_EXIT(end_with(32 * mib,
                       [] {
                         guard_no_more();
                         ask_memory(64 * mib);
                       }),
              ::testing::ExitedWithCode(0), "");
}

TEST(MemoryGuard, AllowsAllWhereNothingIsPromised) {
  EXPECT_TRUE(memory_allows(std::uint64_t{1} << 60));
  EXPECT_NO_THROW(ask_memory(std::uint64_t{1} << 60));
  EXPECT_FALSE(memory_refusal().refused);
}

// Code that no longer runs is not resident, and runs again as it did.
TEST(ResourceUsage, CodePagesComeBack) {
  constexpr std::uint64_t much = std::uint64_t{100} << 10;
  std::uint64_t before = resident_bytes(), after = before;
  for (int i = 0; i < 5 && after + much > before; ++i) {  // the system may take and bring pages meanwhile
    before = resident_bytes();
    forget_code_pages();
    after = resident_bytes();
  }
  EXPECT_LT(after + much, before);
  EXPECT_GT(cpu_seconds(), 0);
}

}  // namespace
}  // namespace vitrail::memory_guard_test

#endif
