// SPDX-License-Identifier: Apache-2.0
// What is published of the tables that the library glazing contains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glazing/color_fidelity_tables.h"
#include "glazing/standard_tables.h"

namespace vitrail::glazing_tables_test {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::Lt;

// CIE 15 gives the observer's sums over 380 to 780 nm.
TEST(GlazingTables, AreTheIlluminantAndTheObserverOfTheCie) {
  const auto d65 = cie_d65_5nm();
  ASSERT_EQ(d65.size(), 107u);
  EXPECT_EQ(d65[0], 0.0341);
  EXPECT_EQ(d65[(560 - 300) / 5], 100);
  const auto observer = cie_1964_5nm();
  ASSERT_EQ(observer.size(), 95u);
  std::array<double, 3> sum{};
  for (std::size_t i = 4; i < 85; ++i)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += observer[i][c];
  EXPECT_THAT(sum, ElementsAre(DoubleNear(23.329353, 1e-6), DoubleNear(23.332036, 2e-6),
                               DoubleNear(23.334153, 1e-6)));
  const auto daylight = cie_daylight_5nm();
  ASSERT_EQ(daylight.size(), 81u);
  EXPECT_THAT(daylight[(380 - 380) / 5], ElementsAre(63.4, 38.5, 3));
  EXPECT_THAT(daylight[(560 - 380) / 5], ElementsAre(100, DoubleNear(0, 1e-12), DoubleNear(0, 1e-12)));
}

TEST(GlazingTables, HaveWeightsThatSumToOne) {
  const auto expect = [](const WeightTable& table, std::size_t rows) {
    ASSERT_EQ(table.size(), rows);
    double sum = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      sum += table[i].second;
      EXPECT_LT(i > 0 ? table[i - 1].first : 0, table[i].first);
    }
    EXPECT_NEAR(sum, 1, 1.5e-4);  // the parts have four decimals
  };
  expect(en_410_solar(), 56);
  expect(iso_9050_1990_solar(), 36);
  expect(iso_9050_1990_ultraviolet(), 20);
}

// The standards' totals, of trapezoids from 305 to 4045 nm: 768.3 and 963.75 W·m⁻², which include the tail.
TEST(GlazingTables, HaveTheSunOfTheStandards) {
  const auto expect = [](const WeightTable& table, double total) {
    ASSERT_EQ(table.size(), 121u);
    double sum = 0;
    for (std::size_t i = 1; i < table.size(); ++i)
      sum += (table[i].first - table[i - 1].first) / 1000 * (table[i].second + table[i - 1].second) / 2;
    EXPECT_NEAR(sum, total, 1.2);
  };
  expect(astm_e891(), 768.3);
  expect(iso_9845_global(), 963.75);
}

TEST(GlazingTables, HaveReflectancesOfColours) {
  ASSERT_EQ(cie_test_colors_5nm().size(), 81u);
  // CIE 13.3, table 1, at 380 nm.
  EXPECT_THAT(cie_test_colors_5nm()[0], ElementsAre(0.219, 0.07, 0.065, 0.074, 0.295, 0.151, 0.378, 0.104));
  for (const auto& row : cie_test_colors_5nm()) EXPECT_THAT(row, Each(AllOf(Ge(0), Lt(1))));
  for (const auto& row : cie_224_samples_5nm()) EXPECT_THAT(row, Each(AllOf(Ge(0), Lt(1))));
  EXPECT_EQ(cie_224_samples_5nm()[0][0], 0.6359f);
}

}  // namespace
}  // namespace vitrail::glazing_tables_test
