// SPDX-License-Identifier: Apache-2.0
#include "partitioner/spilling/spill_instances.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace vitrail::spill_instances_test {
namespace {

// More parts than the process may have files open; each is written several times.
TEST(InstanceSpill, HasMorePartsThanFilesMayBeOpen) {
  rlimit files{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &files), 0);
  const rlimit few{32, files.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  const test::TemporaryDirectory directory;
  constexpr std::uint32_t parts = 100, rounds = 80;
  std::vector<Bounds3f> cells;
  for (std::uint32_t i = 0; i < parts; ++i) {
    const auto x = static_cast<float>(i);
    cells.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  InstanceSpill spill(directory.path(), cells, {{0, 0, 0}, {parts, 1, 1}}, 4096);
  for (std::uint32_t round = 0; round < rounds; ++round)
    for (std::uint32_t i = 0; i < parts; ++i) {
      InstanceRef ref;
      for (int axis = 0; axis < 3; ++axis) ref.lower[axis] = .4f, ref.upper[axis] = .6f;
      ref.lower[0] += static_cast<float>(i), ref.upper[0] += static_cast<float>(i);
      ref.object = i, ref.first_triangle = round;
      spill.add(ref);
    }
  spill.flush();
  EXPECT_EQ(spill.bytes(), std::uint64_t{parts} * rounds * sizeof(InstanceRef));
  for (std::uint32_t i = 0; i < parts; ++i) {
    const std::vector<InstanceRef> taken = spill.take(i);
    ASSERT_EQ(taken.size(), rounds);
    for (std::uint32_t round = 0; round < rounds; ++round) {
      EXPECT_EQ(taken[round].object, i);
      EXPECT_EQ(taken[round].first_triangle, round);
    }
    EXPECT_TRUE(spill.take(i).empty()) << "taken before";
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  ::setrlimit(RLIMIT_NOFILE, &files);
}

}  // namespace
}  // namespace vitrail::spill_instances_test
