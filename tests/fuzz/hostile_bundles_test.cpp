// SPDX-License-Identifier: Apache-2.0
// Bundles with numbers that no program writes, their checksums right: each is refused or rendered. What
// fuzz_bundle.cpp does, without a fuzzer.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tests/farm/machine_limits.h"
#include "tests/fuzz/bundle_seeds.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace vitrail::test::hostile_bundles_test {
namespace {

template <class T>
void add(std::vector<std::string>& patterns, std::initializer_list<T> values) {
  for (const T& value : values) patterns.emplace_back(reinterpret_cast<const char*>(&value), sizeof value);
}

std::vector<std::string> hostile_numbers() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<std::string> patterns;
  add<float>(patterns, {0, -1, 1e-45f, 1e30f, -1e30f, 3e38f, infinity, -infinity, std::nanf("")});
  add<double>(patterns, {-1, 1e300, -1e300, 1e-300, 1e18, std::nan("")});
  add<std::uint32_t>(patterns, {0, 1, 7, 255, 65536, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff});
  add<std::uint8_t>(patterns, {0, 1, 5, 17, 127, 255});
  return patterns;
}

TEST(HostileBundles, AreRefusedOrRendered) {
  std::vector<std::string> seeds;
  add_bundle_seeds([&](const std::string& format, const std::string& bytes) {
    if (format == "bundle") seeds.push_back(bytes);
  });
  ASSERT_GT(seeds.size(), 20u);
  const std::vector<std::string> patterns = hostile_numbers();
  LLVMFuzzerTestOneInput(nullptr, 0);  // writes the sample, for all children
  const int rounds = std::getenv("VITRAIL_LONG_TESTS") ? 2000 : 25;
  constexpr int of_a_round = 40;
  for (int round = 0; round < rounds; ++round)
    EXPECT_EQ(wait_for(start_child([&] {
                std::mt19937 dice(static_cast<unsigned>(round));
                for (int i = 0; i < of_a_round; ++i) {
                  ::alarm(300);
                  std::string bundle = seeds[dice() % seeds.size()];
                  for (auto changes = 1 + dice() % 3; changes > 0; --changes) {
                    const std::string& pattern = patterns[dice() % patterns.size()];
                    bundle.replace(dice() % (bundle.size() - pattern.size()), pattern.size(), pattern);
                  }
                  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bundle.data()), bundle.size());
                }
              })),
              0)
        << "round " << round;
  std::filesystem::remove_all(fuzz::folder());
}

}  // namespace
}  // namespace vitrail::test::hostile_bundles_test
