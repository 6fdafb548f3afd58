// SPDX-License-Identifier: Apache-2.0
// How tables of numbers are read, and those that the library scene contains.
#include "scene/system/number_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <span>

#include "scene/daylight/sky_tables.h"
#include "scene/spectra/metal_tables.h"

namespace vitrail::number_tables_test {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

TEST(NumberTables, AreNamedRowsBesideComments) {
  const auto tables = number_tables<double>("# source\n\n[a-1]\n1 -2.5\n# more\n3e-2 4\n[b]\n7", "t.txt");
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].name, "a-1");
  EXPECT_EQ(tables[0].columns, 2u);
  EXPECT_THAT(tables[0].values, ElementsAre(1, -2.5, 3e-2, 4));
  EXPECT_EQ(tables[1].name, "b");
  EXPECT_THAT(tables[1].values, ElementsAre(7));
  EXPECT_TRUE(number_tables<float>("# nothing\n", "t.txt").empty());
}

// The double nearest to both is 1 + 2⁻²⁴, halfway between two floats, of which 1 is the even one.
TEST(NumberTables, RoundEachNumberOnce) {
  const std::string_view text = "[t]\n1.0000000596046448 1.000000059604644775390625";
  constexpr float next = 1 + std::numeric_limits<float>::epsilon();
  EXPECT_THAT(number_tables<float>(text, "t.txt")[0].values, ElementsAre(next, 1.0f));
  EXPECT_THAT(number_tables<double>(text, "t.txt")[0].values, ElementsAre(1 + 0x1p-24, 1 + 0x1p-24));
}

void expect_error(std::string_view text, const char* message, int line, int column, const char* excerpt) {
  try {
    number_tables<float>(text, "t.txt");
    ADD_FAILURE() << "no error in " << text;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(message));
    EXPECT_EQ(error.location.file, "t.txt");
    EXPECT_EQ(error.location.line, line) << text;
    EXPECT_EQ(error.location.column, column) << text;
    EXPECT_EQ(error.excerpt, excerpt);
  }
}

TEST(NumberTables, NameTheLineThatIsWrong) {
  expect_error("1 2\n", "expected [name] before the first row", 1, 1, "1 2");
  expect_error("# x\n[a\n1\n", "expected [name]", 2, 1, "[a");
  expect_error("[]\n1\n", "expected [name]", 1, 1, "[]");
  expect_error("[a]\n1 2x 3\n", "expected a number", 2, 3, "1 2x 3");
  for (const char* row :
       {"1  2", "1 ", " 1", "1,2", "1\t2", "nan", "inf", "1e99", "0x1", "one", "+1", "1\r"}) {
    const std::string text = std::string("[a]\n") + row;
    EXPECT_THROW(number_tables<float>(text, "t.txt"), Error) << row;
  }
  expect_error("[a]\n1 2\n\n3\n", "a row of the table a has 1 numbers, not 2", 4, 1, "3");
  expect_error("[a]\n[b]\n1\n", "the table a has no row", 0, 0, "");
  expect_error("[a]\n1\n[b]\n", "the table b has no row", 0, 0, "");
}

TEST(NumberTables, AreFoundByNameAndShape) {
  const auto tables = number_tables<float>("[a]\n1 2\n3 4\n", "t.txt");
  EXPECT_EQ(&find_table(tables, "a", 2), &tables[0]);
  EXPECT_THROW(find_table(tables, "b", 2), Error);
  EXPECT_THROW(find_table(tables, "a", 4), Error);
  std::array<std::array<float, 2>, 2> square{};
  fill_from(tables, "a", 2, square);
  EXPECT_THAT(square[1], ElementsAre(3, 4));
  std::array<std::array<float, 2>, 3> longer{};
  EXPECT_THROW(fill_from(tables, "a", 2, longer), Error);
  std::array<float, 2> shorter{};
  EXPECT_THROW(fill_from(tables, "a", 2, shorter), Error);
}

// ArHosekSkyModelData_Spectral.h, version 1.4a: the first control point of 360 nm, and limb darkening at 360
// and 560 nm.
TEST(SkyTables, AreThoseOfHosekAndWilkie) {
  const SkyTables& sky = sky_tables();
  EXPECT_THAT(std::span(sky.shape[0][0][0][0]).first(5),
              ElementsAre(-2.97429f, -1.670904f, -5.183199f, 5.377376f, -0.02904124f));
  EXPECT_THAT(sky.limb[0],
              ElementsAreArray({0.122953f, 1.01278f, 0.238687f, -1.12208f, 1.17087f, -0.424947f}));
  EXPECT_THAT(sky.limb[5], ElementsAreArray({0.26892f, 1.34319f, -1.58427f, 1.91271f, -1.31350f, 0.37295f}));
}

TEST(MetalTables, RiseInWavelengthAndHavePublishedValues) {
  const std::vector<NumberTable<float>>& metals = metal_tables();
  EXPECT_EQ(metals.size(), 72u);
  for (const NumberTable<float>& metal : metals) {
    EXPECT_EQ(metal.columns, 3u) << metal.name;
    for (std::size_t at = metal.columns; at < metal.values.size(); at += metal.columns)
      EXPECT_LT(metal.values[at - metal.columns], metal.values[at]) << metal.name;
  }
  // As pbrt prints them at 539.061646 nm.
  const auto eta_of = [&](std::string_view name) {
    const NumberTable<float>& metal = find_table(metals, name, 3);
    for (std::size_t at = 0; at < metal.values.size(); at += 3)
      if (metal.values[at] == 539.0616f) return metal.values[at + 1];
    return 0.0f;
  };
  EXPECT_EQ(eta_of("Au"), 0.402f);
  EXPECT_EQ(eta_of("Al"), 0.912f);
}

}  // namespace
}  // namespace vitrail::number_tables_test
