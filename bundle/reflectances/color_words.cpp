// SPDX-License-Identifier: Apache-2.0
#include "bundle/reflectances/color_words.h"

#include <algorithm>
#include <bit>

#include "bundle/light_code.h"
#include "bundle/reflectances/reflectance_table.h"

namespace vitrail {

TexelWords reflectance_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter) {
  if (const auto nodes = tabulated_reflectance(color)) return pack({*nodes});
  return pack({fitter(
      {static_cast<double>(color[0]), static_cast<double>(color[1]), static_cast<double>(color[2])})});
}

TexelWords light_words(const std::array<float, 3>& color, const ReflectanceFitter& fitter) {
  const float scale = 2 * std::max({color[0], color[1], color[2]});
  if (!(scale > 0)) return pack({{}, 0});
  if (const auto nodes = tabulated_reflectance({color[0] / scale, color[1] / scale, color[2] / scale}))
    return pack({*nodes, scale});
  const auto part = [&](std::size_t i) { return static_cast<double>(color[i]) / static_cast<double>(scale); };
  return pack({fitter({part(0), part(1), part(2)}), scale});
}

std::optional<std::array<float, 3>> coded_color(TexelFormat of_file, const TexelWords& words,
                                                std::span<const float> values) {
  const std::uint32_t last = words[words_per_texel(read_format(of_file)) - 1];
  if (!finds_spectra(of_file) || !is_color_code(last)) return {};
  if (of_file != TexelFormat::light_code_16)
    return std::array{values[last & 0xff], values[last >> 8 & 0xff], values[last >> 16 & 0xff]};
  if (!is_color_code(words[1])) return {};
  const LightCodes codes = codes_of_words(words);
  return std::array{value_of_code(codes[0]), value_of_code(codes[1]), value_of_code(codes[2])};
}

TexelWords found_words(TexelFormat of_file, const TexelWords& words, std::span<const float> values,
                       const ReflectanceFitter& fitter) {
  const auto color = coded_color(of_file, words, values);
  if (!color)  // another thread has stored two words of the spectrum meanwhile
    return {words[0], words[1], std::bit_cast<std::uint32_t>(2 * greatest_of_words(words))};
  return of_file == TexelFormat::color_code ? reflectance_words(*color, fitter) : light_words(*color, fitter);
}

}  // namespace vitrail
