// SPDX-License-Identifier: Apache-2.0
#include "compare/error_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "scene/color.h"

namespace vitrail {

namespace {

using Color = std::array<float, 3>;

Color heat(double fraction) {
  const auto h = static_cast<float>(3 * std::clamp(fraction, 0.0, 1.0));
  return {std::clamp(h, 0.f, 1.f), std::clamp(h - 1, 0.f, 1.f), std::clamp(h - 2, 0.f, 1.f)};
}

Color side(double fraction) {
  const auto f = static_cast<float>(std::clamp(fraction, -1.0, 1.0));
  return f < 0 ? Color{1 + f, 1 + f, 1} : Color{1, 1 - f, 1 - f};
}

void put(Image& image, int x, int y, const Color& color) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const auto p =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
  std::copy(color.begin(), color.end(), image.values.begin() + static_cast<std::ptrdiff_t>(3 * p));
}

// Three columns and five rows a character, a digit of the octal number a row from the top.
constexpr std::string_view glyphs = "0123456789.e-+";
constexpr std::array<unsigned, glyphs.size()> glyph_rows{075557, 026227, 071747, 071717, 055711,
                                                         074717, 074757, 071122, 075757, 075717,
                                                         000002, 007743, 000700, 002720};
constexpr int glyph_width = 4, glyph_height = 5;

void write_text(Image& image, int x, int y, const std::string& text) {
  for (const char c : text) {
    const std::size_t glyph = glyphs.find(c);
    for (int row = 0; glyph != std::string_view::npos && row < glyph_height; ++row)
      for (int column = 0; column < 3; ++column)
        if (glyph_rows[glyph] >> (3 * (glyph_height - 1 - row) + 2 - column) & 1)
          put(image, x + column, y + row, {1, 1, 1});
    x += glyph_width;
  }
}

}  // namespace

double hottest(const std::vector<double>& error_map) {
  std::vector<double> sorted;
  for (const double e : error_map)
    if (!std::isnan(e)) sorted.push_back(e);
  if (sorted.empty()) return 0;
  const auto percentile = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
  std::nth_element(sorted.begin(), percentile, sorted.end());
  return *percentile > 0 ? *percentile : *std::max_element(sorted.begin(), sorted.end());
}

Image heatmap(const std::vector<double>& error_map, int width, int height, double hottest) {
  Image image = black_image(width, height, 3);
  for (std::size_t p = 0; p < error_map.size(); ++p) {
    const double e = error_map[p];
    const Color color = std::isnan(e) ? Color{1, 0, 1} : heat(hottest > 0 ? e / hottest : 0);
    std::copy(color.begin(), color.end(), image.values.begin() + static_cast<std::ptrdiff_t>(3 * p));
  }
  return image;
}

Image error_image(const std::vector<double>& error_map, int width, int height) {
  Image image = black_image(width, height, 3);
  for (std::size_t p = 0; p < error_map.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) image.values[3 * p + c] = static_cast<float>(error_map[p]);
  return image;
}

Image signed_difference(const Image& image, const Image& reference) {
  Image difference = image;
  for (std::size_t i = 0; i < difference.values.size(); ++i) difference.values[i] -= reference.values[i];
  return difference;
}

Image signed_map(const Image& difference, double hottest) {
  Image image = black_image(difference.width, difference.height, 3);
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const float* v = &difference.values[3 * p];
    const double y =
        srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}).y;
    const Color color = std::isnan(y) ? Color{1, 0, 1} : side(hottest > 0 ? y / hottest : 0);
    std::copy(color.begin(), color.end(), image.values.begin() + static_cast<std::ptrdiff_t>(3 * p));
  }
  return image;
}

Image with_legend(const Image& image, double hottest, bool is_signed) {
  constexpr int least_width = 64, bar_height = 6, band_height = 16;
  if (image.width < least_width) return image;
  Image whole = black_image(image.width, image.height + band_height, 3);
  std::copy(image.values.begin(), image.values.end(), whole.values.begin());
  for (int x = 0; x < image.width; ++x) {
    const double at = (x + 0.5) / image.width;
    for (int y = 0; y < bar_height; ++y)
      put(whole, x, image.height + 1 + y, is_signed ? side(2 * at - 1) : heat(at));
  }
  const int row = image.height + bar_height + 3;
  const std::string greatest = fmt::format("{:.3g}", hottest);
  write_text(whole, 1, row, is_signed ? "-" + greatest : "0");
  if (is_signed) write_text(whole, image.width / 2 - 1, row, "0");
  write_text(whole, image.width - glyph_width * static_cast<int>(greatest.size()), row, greatest);
  return whole;
}

}  // namespace vitrail
