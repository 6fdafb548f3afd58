// SPDX-License-Identifier: Apache-2.0
#include "film/wide_sum.h"

#include <gtest/gtest.h>

#include <barrier>
#include <random>
#include <thread>
#include <vector>

namespace vitrail::wide_sum_test {
namespace {

// Of all sizes and both signs.
Int128 any(std::mt19937_64& random) {
  const Int128 bits = static_cast<Int128>(random()) << 64 | random();
  return bits >> (random() % 127);
}

TEST(WideSum, IsATwosComplement) {
  EXPECT_EQ(wide_sum(-1), (WideSum{~0ull, ~0ull}));
  EXPECT_EQ(wide_sum(Int128{1} << 64), (WideSum{0, 1}));
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const Int128 v = any(random);
    EXPECT_TRUE(value_of(wide_sum(v)) == v);
  }
}

TEST(WideSum, AddsAsInt128) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100000; ++i) {
    const Int128 a = any(random) >> 1, b = any(random) >> 1;
    WideSum sum = wide_sum(a), shared = sum;
    sum += wide_sum(b);
    add_shared(shared, wide_sum(b));
    EXPECT_TRUE(value_of(sum) == a + b);
    EXPECT_EQ(shared, sum);
  }
}

TEST(WideSum, TakesWholeNumbersOfDoubles) {
  for (const double v : {0.0, 1.0, -1.0, 0x1p53, -0x1p53, 0x1.fffffffffffffp61, 0x1p62, -0x1p62, 0x1p64,
                         -0x1p63, 0x1.23456789abcdep84, -0x1.23456789abcdep84, 0x1p126})
    EXPECT_EQ(static_cast<double>(value_of(wide_sum_of(v))), v);
}

// Carries and borrows of the lower half go back and forth between the threads.
TEST(WideSum, LosesNoCarryBetweenThreads) {
  constexpr int thread_count = 4, additions = 200000;
  WideSum sum;
  Int128 expected = 0;
  std::vector<std::vector<Int128>> shares(thread_count);
  for (int t = 0; t < thread_count; ++t) {
    std::mt19937_64 random(static_cast<std::uint64_t>(10 + t));
    for (int i = 0; i < additions; ++i) {
      const auto size = static_cast<Int128>(random() | 1ull << 63);  // every second one carries
      shares[static_cast<std::size_t>(t)].push_back(random() % 2 ? size : -size);
      expected += shares[static_cast<std::size_t>(t)].back();
    }
  }
  std::barrier start(thread_count);
  {
    std::vector<std::jthread> threads;
    for (const std::vector<Int128>& share : shares)
      threads.emplace_back([&] {
        start.arrive_and_wait();
        for (const Int128 v : share) add_shared(sum, wide_sum(v));
      });
  }
  EXPECT_TRUE(value_of(sum) == expected);
}

}  // namespace
}  // namespace vitrail::wide_sum_test
