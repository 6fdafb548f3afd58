// SPDX-License-Identifier: Apache-2.0
#include "film/false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "scene/daylight/photometry.h"
#include "scene/records/pixel_place.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

constexpr std::array<std::array<int, 3>, 10> viridis{{{68, 1, 84},
                                                      {72, 40, 120},
                                                      {62, 74, 137},
                                                      {49, 104, 142},
                                                      {38, 130, 142},
                                                      {31, 158, 137},
                                                      {53, 183, 121},
                                                      {109, 205, 89},
                                                      {180, 222, 44},
                                                      {253, 231, 37}}};
constexpr double decades = 3;

using Color = std::array<float, 3>;

Color color_at(double part) {
  const double at = std::clamp(part, 0.0, 1.0) * (viridis.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = std::lerp(viridis[low][c], viridis[low + 1][c], at - static_cast<double>(low));
    color[c] = static_cast<float>(srgb_decode(x / 255));
  }
  return color;
}

// Where a luminance lies on the scale, 0 … 1.
double part_of(double luminance, const FalseColor& manner) {
  const double part = luminance / manner.most;
  if (!manner.logarithmic) return part;
  return part > 0 ? 1 + std::log10(part) / decades : 0;
}

// Five wide and seven high; a bit a pixel, the highest the left one.
struct Glyph {
  char letter;
  std::array<unsigned char, 7> rows;
};
constexpr std::array<Glyph, 18> glyphs{{{'0', {14, 17, 19, 21, 25, 17, 14}},
                                        {'1', {4, 12, 4, 4, 4, 4, 14}},
                                        {'2', {14, 17, 1, 2, 4, 8, 31}},
                                        {'3', {31, 2, 4, 2, 1, 17, 14}},
                                        {'4', {2, 6, 10, 18, 31, 2, 2}},
                                        {'5', {31, 16, 30, 1, 1, 17, 14}},
                                        {'6', {6, 8, 16, 30, 17, 17, 14}},
                                        {'7', {31, 1, 2, 4, 8, 8, 8}},
                                        {'8', {14, 17, 17, 14, 17, 17, 14}},
                                        {'9', {14, 17, 17, 15, 1, 2, 12}},
                                        {'.', {0, 0, 0, 0, 0, 12, 12}},
                                        {'c', {0, 0, 14, 16, 16, 17, 14}},
                                        {'d', {1, 1, 13, 19, 17, 17, 15}},
                                        {'m', {0, 0, 26, 21, 21, 17, 17}},
                                        {'e', {0, 0, 14, 17, 31, 16, 14}},
                                        {'+', {0, 4, 4, 31, 4, 4, 0}},
                                        {'-', {0, 0, 0, 31, 0, 0, 0}},
                                        {'/', {0, 1, 2, 4, 8, 16, 0}}}};
constexpr int glyph_width = 6, glyph_height = 7;

class Canvas {
 public:
  Canvas(Image& image, int zoom) : image_(image), zoom_(zoom) {}
  void fill(int x0, int x1, int y0, int y1, const Color& color) {
    for (int y = std::max(0, y0); y < std::min(y1, image_.height); ++y)
      for (int x = std::max(0, x0); x < std::min(x1, image_.width); ++x)
        std::copy(color.begin(), color.end(), &image_.values[3 * pixel_place(x, y, image_.width)]);
  }
  void text(int x, int y, std::string_view words) {
    for (const char letter : words) {
      const auto glyph = std::ranges::find(glyphs, letter, &Glyph::letter);
      for (int row = 0; glyph != glyphs.end() && row < glyph_height; ++row)
        for (int bit = 0; bit < 5; ++bit)
          if (glyph->rows[static_cast<std::size_t>(row)] >> (4 - bit) & 1)
            fill(x + bit * zoom_, x + (bit + 1) * zoom_, y + row * zoom_, y + (row + 1) * zoom_, {1, 1, 1});
      x += glyph_width * zoom_;
    }
  }

 private:
  Image& image_;
  int zoom_;
};

std::string words_of(double luminance) { return fmt::format("{:.6g}", luminance); }

// Luminances that the scale names, from its lower end to its upper.
std::vector<double> ticks_of(const FalseColor& manner) {
  std::vector<double> ticks;
  if (manner.logarithmic)
    for (int i = static_cast<int>(decades); i >= 0; --i) ticks.push_back(manner.most / std::pow(10, i));
  else
    for (int i = 0; i <= 5; ++i) ticks.push_back(manner.most * i / 5);
  return ticks;
}

}  // namespace

double round_above(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= x * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

Image false_colored(const Image& rgb, FalseColor manner) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i + 2 < rgb.values.size(); i += 3)
    luminances.push_back(photometric(srgb_to_xyz({rgb.values[i], rgb.values[i + 1], rgb.values[i + 2]}).y));
  if (!(manner.most > 0)) {
    std::vector<double> sorted = luminances;
    const auto high =
        sorted.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(sorted.size() - 1) * 0.999);
    std::nth_element(sorted.begin(), high, sorted.end());
    manner.most = *high > 0 ? round_above(*high) : 1;
  }

  const int zoom = std::max(1, rgb.height / 360);
  std::vector<std::string> labels;
  std::size_t widest = 5;  // cd/m2
  for (const double tick : ticks_of(manner)) {
    labels.push_back(words_of(tick));
    widest = std::max(widest, labels.back().size());
  }
  const int pad = 6 * zoom, bar = 14 * zoom, line = (glyph_height + 3) * zoom;
  const int least = 2 * pad + line * (static_cast<int>(labels.size()) + 2);
  Image image = black_image(rgb.width + 3 * pad + bar + static_cast<int>(widest) * glyph_width * zoom,
                            std::max(rgb.height, least), 3);
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      const Color color = color_at(part_of(luminances[pixel_place(x, y, rgb.width)], manner));
      std::copy(color.begin(), color.end(), &image.values[3 * pixel_place(x, y, image.width)]);
    }

  Canvas canvas(image, zoom);
  const int left = rgb.width + pad, right = left + bar, top = pad + 2 * line,
            bottom = image.height - pad - line / 2;
  canvas.text(left, pad, "cd/m2");
  for (int y = top; y < bottom; ++y)
    canvas.fill(left, right, y, y + 1, color_at((bottom - y - 0.5) / (bottom - top)));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(labels.size() - 1);
    const int y = bottom - static_cast<int>(std::lround(part * (bottom - top)));
    canvas.fill(right - 3 * zoom, right + 2 * zoom, y - zoom / 2, y - zoom / 2 + zoom, {1, 1, 1});
    canvas.text(right + pad, y - glyph_height * zoom / 2, labels[i]);
  }
  return image;
}

}  // namespace vitrail
