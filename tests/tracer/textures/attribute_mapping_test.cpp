// SPDX-License-Identifier: Apache-2.0
// Images and checkerboards that lie where an attribute of a mesh says: its first number is s, its second t.
#include <gtest/gtest.h>

#include <bit>

#include "bundle/texture_file.h"
#include "tests/support/temporary_directory.h"
#include "tracer/textures/texture_ranges.h"

namespace vitrail::attribute_mapping_test {
namespace {

// Corners of a triangle across the middle of which s is .75 and t .25.
constexpr AttributeValue at_three_quarters{{{{.75f, .25f, 0}, {.7f, .2f, 0}, {.8f, .3f, 0}}},
                                           {.5f, .25f, .25f}};

TexturePoint seen_at(const std::vector<AttributeValue>& attributes) {
  TexturePoint point;
  point.uv = {.25, .75};  // elsewhere
  point.attributes = attributes;
  return point;
}

TEST(AttributeMapping, ImagesLieBySAndT) {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directories(folder.path() / "textures");
  write_texture_file(folder.path() / "textures/000000.tex", {TexelFormat::number, 2, 2, 1},
                     [](std::uint32_t, std::uint32_t x, std::uint32_t y) {
                       return TexelWords{std::bit_cast<std::uint32_t>(static_cast<float>(10 * x + y))};
                     });
  ImageTexture image;
  image.filename = "textures/000000.tex";
  image.filter = TextureFilter::nearest;
  image.mapping = UvMapping{};
  const std::vector<Texture> by_uv{Texture{image, true, "", {}}};
  image.mapping = AttributeMapping{"1"};
  const std::vector<Texture> by_attribute{Texture{image, true, "", {}}};
  const Textures of_uv(by_uv, folder.path(), 1 << 20), of_attribute(by_attribute, folder.path(), 1 << 20);
  const FloatParameter parameter{Id<Texture>{0}};

  const std::vector<AttributeValue> attributes{AttributeValue{}, at_three_quarters};
  TexturePoint there;
  there.uv = {.75, .25};
  const double expected = of_uv.number(parameter, there);
  EXPECT_NE(expected, of_uv.number(parameter, seen_at(attributes)));
  EXPECT_EQ(of_attribute.number(parameter, seen_at(attributes)), expected);
}

// The means of a region's corners: of the first number for s, of the second for t.
TEST(AttributeMapping, CheckerboardsAreBoundedBySAndT) {
  CheckerboardTexture board;
  board.even = ConstantSpectrum{.25f}, board.odd = ConstantSpectrum{.75f};
  board.mapping = AttributeMapping{"0"};
  const std::vector<Texture> records{Texture{board, false, "", {}}};
  const test::TemporaryDirectory folder;
  const Textures textures(records, folder.path(), 1 << 20);
  // s within one cell, t across two that lie beside it: half of each.
  const std::vector<AttributeValue> across_t{{{{{.2f, 0, 0}, {.3f, 2, 0}, {.4f, 1, 0}}}, {1, 0, 0}}},
      in_an_odd_cell{{{{{1.2f, .1f, 0}, {1.3f, .2f, 0}, {1.4f, .3f, 0}}}, {1, 0, 0}}},
      in_an_even_cell{{{{{1.2f, 1.1f, 0}, {1.3f, 1.2f, 0}, {1.4f, 1.3f, 0}}}, {1, 0, 0}}};
  const auto mean = [&](const std::vector<AttributeValue>& attributes) {
    TextureRegion region;
    region.middle = seen_at(attributes);
    const double constant = TextureRanges(&textures, records).luminances(ConstantSpectrum{1}, region).mean;
    return TextureRanges(&textures, records).luminances(Id<Texture>{0}, region).mean / constant;
  };
  EXPECT_NEAR(mean(across_t), .5, 1e-6);
  EXPECT_NEAR(mean(in_an_odd_cell), .75, 1e-6);
  EXPECT_NEAR(mean(in_an_even_cell), .25, 1e-6);
}

}  // namespace
}  // namespace vitrail::attribute_mapping_test
