// SPDX-License-Identifier: Apache-2.0
#include "film/neighbours.h"

#include <gtest/gtest.h>

#include <vector>

namespace vitrail::neighbours_test {
namespace {

TEST(Neighbours, AreAddedOnBothSidesOfAPixel) {
  const Neighbours along = along_axis(std::vector<double>{2, 1, 0.5});
  EXPECT_EQ(along.of_mean, 1 + 2 * (0.5 + 0.25));
  EXPECT_EQ(along.of_variances, 1 + 2 * (0.25 + 0.0625));
  EXPECT_EQ(along_axis(std::vector<double>{2}), Neighbours{});
  EXPECT_EQ(product({2, 3}, {5, 7}), (Neighbours{10, 21}));
}

TEST(Neighbours, AreReadFromWhatAFilmSaysOfItself) {
  EXPECT_EQ(neighbours_of(R"({"neighbours": [2.5, 1.625]})"), (Neighbours{2.5, 1.625}));
  EXPECT_EQ(neighbours_of(R"({"neighbours": [0.5, "many"]})"), Neighbours{});
  for (const char* about : {"", "no JSON", "{}", R"({"neighbours": 2})", R"({"neighbours": [2, 2, 2]})"})
    EXPECT_EQ(neighbours_of(about), Neighbours{}) << about;
}

}  // namespace
}  // namespace vitrail::neighbours_test
