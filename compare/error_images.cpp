// SPDX-License-Identifier: Apache-2.0
#include "compare/error_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "scene/spectra/color.h"

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

// Every eighth colour of the map's 256, encoded in 8 bits as sRGB; between them it is linear to 1 %.
constexpr std::array<std::array<int, 3>, 33> magma_colors{
    {{0, 0, 4},       {3, 3, 18},      {10, 8, 34},     {19, 13, 52},    {29, 17, 71},    {41, 17, 90},
     {54, 16, 107},   {68, 15, 118},   {81, 18, 124},   {93, 23, 127},   {106, 28, 129},  {118, 33, 129},
     {131, 38, 129},  {144, 42, 129},  {156, 46, 127},  {170, 51, 125},  {183, 55, 121},  {196, 60, 117},
     {208, 65, 111},  {220, 72, 105},  {231, 82, 99},   {239, 93, 94},   {245, 107, 92},  {249, 121, 93},
     {252, 137, 97},  {253, 152, 105}, {254, 167, 114}, {254, 182, 124}, {254, 196, 136}, {254, 211, 149},
     {253, 226, 163}, {252, 240, 178}, {252, 253, 191}}};

Color magma(double fraction) {
  const double at = std::clamp(fraction, 0.0, 1.0) * (magma_colors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), magma_colors.size() - 2);
  Color color;
  for (std::size_t c = 0; c < 3; ++c) {
    const double encoded =
        std::lerp(magma_colors[below][c], magma_colors[below + 1][c], at - static_cast<double>(below));
    color[c] = static_cast<float>(srgb_decode(encoded / 255));
  }
  return color;
}

// `fraction` is in [0, 1], of sides in [−1, 1].
Color color_of(Palette palette, double fraction) {
  switch (palette) {
    case Palette::heat:
      return heat(fraction);
    case Palette::magma:
      return magma(fraction);
    case Palette::sides:
      return side(fraction);
  }
  return {};
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

Image heatmap(const std::vector<double>& error_map, int width, int height, double hottest, Palette palette) {
  const Color unknown = palette == Palette::magma ? Color{0, 1, 0} : Color{1, 0, 1};
  Image image = black_image(width, height, 3);
  for (std::size_t p = 0; p < error_map.size(); ++p) {
    const double e = error_map[p];
    const Color color = std::isnan(e) ? unknown : color_of(palette, hottest > 0 ? e / hottest : 0);
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

Image with_legend(const Image& image, double hottest, Palette palette) {
  const bool is_signed = palette == Palette::sides;
  constexpr int least_width = 64, bar_height = 6, band_height = 16;
  if (image.width < least_width) return image;
  Image whole = black_image(image.width, image.height + band_height, 3);
  std::copy(image.values.begin(), image.values.end(), whole.values.begin());
  for (int x = 0; x < image.width; ++x) {
    const double at = (x + 0.5) / image.width;
    for (int y = 0; y < bar_height; ++y)
      put(whole, x, image.height + 1 + y, color_of(palette, is_signed ? 2 * at - 1 : at));
  }
  const int row = image.height + bar_height + 3;
  const std::string greatest = fmt::format("{:.3g}", hottest);
  write_text(whole, 1, row, is_signed ? "-" + greatest : "0");
  if (is_signed) write_text(whole, image.width / 2 - 1, row, "0");
  write_text(whole, image.width - glyph_width * static_cast<int>(greatest.size()), row, greatest);
  return whole;
}

}  // namespace vitrail
