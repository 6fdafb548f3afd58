// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_image.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

using Color = std::array<float, 3>;

// One row or column of `count` numbers, `stride` apart, to max(1, count/2): each is the mean over its length.
void halve(const float* from, int count, std::ptrdiff_t stride, float* to, std::ptrdiff_t to_stride) {
  const int half = std::max(1, count / 2);
  const double length = static_cast<double>(count) / half;
  for (int i = 0; i < half; ++i) {
    const double begin = i * length, end = i + 1 == half ? count : (i + 1) * length;
    double sum = 0;
    for (int k = static_cast<int>(begin); k < count && k < end; ++k)
      sum += static_cast<double>(from[k * stride]) * (std::min(k + 1.0, end) - std::max<double>(k, begin));
    to[i * to_stride] = static_cast<float>(sum / length);
  }
}

Color color_at(const Image& image, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const float* const value = &image.values[pixel * channels];
  if (channels < 3) return {value[0], value[0], value[0]};
  return {value[0], value[1], value[2]};
}

bool all_are_multiples(const Image& image, double of) {
  return std::all_of(image.values.begin(), image.values.end(), [of](float value) {
    const double v = static_cast<double>(value) * of;
    return v > -0.5 && v < of + 0.5 && std::abs(v - std::nearbyint(v)) < 0.01;
  });
}

bool is_grey(const Image& image) {
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const Color c = color_at(image, p);
    if (c[0] != c[1] || c[1] != c[2]) return false;
  }
  return true;
}

TexelFormat format_for(const Image& image, TextureUse use) {
  if (use == TextureUse::number) return TexelFormat::number;
  if (use == TextureUse::vector) {
    if (all_are_multiples(image, 255)) return TexelFormat::vector_8;
    return all_are_multiples(image, 65535) ? TexelFormat::vector_16 : TexelFormat::vector_float;
  }
  if (use == TextureUse::illuminant) return TexelFormat::illuminant;
  if (is_grey(image)) return TexelFormat::number;
  if (use == TextureUse::reflectance || *std::max_element(image.values.begin(), image.values.end()) <= 1)
    return TexelFormat::reflectance;
  return TexelFormat::unbounded;
}

TexelWords vector_words(const Color& c, TexelFormat format) {
  if (format == TexelFormat::vector_float)
    return {std::bit_cast<std::uint32_t>(c[0]), std::bit_cast<std::uint32_t>(c[1]),
            std::bit_cast<std::uint32_t>(c[2])};
  const double most = format == TexelFormat::vector_8 ? 255 : 65535;
  const auto part = [&](std::size_t i) {
    return static_cast<std::uint32_t>(std::nearbyint(std::clamp(static_cast<double>(c[i]), 0.0, 1.0) * most));
  };
  if (format == TexelFormat::vector_8) return {part(0) | part(1) << 8 | part(2) << 16};
  return {part(0) | part(1) << 16, part(2)};
}

// As reflectance_from_rgb, unbounded_from_rgb and emission_from_rgb.
TexelWords spectral_words(const Color& c, TexelFormat format, const ReflectanceFitter& fitter) {
  const double greatest = static_cast<double>(std::max({c[0], c[1], c[2]}));
  double scale = 1;
  if (format == TexelFormat::illuminant || (format == TexelFormat::unbounded && greatest > 1))
    scale = 2 * greatest;
  if (!(scale > 0)) return pack({{}, 0});
  return pack({fitter({static_cast<double>(c[0]) / scale, static_cast<double>(c[1]) / scale,
                       static_cast<double>(c[2]) / scale}),
               static_cast<float>(scale)});
}

// The words of all texels, in the order of the image. Neighbours often have the same colour.
std::vector<TexelWords> words_of(const Image& image, TexelFormat format, const ReflectanceFitter& fitter) {
  std::vector<TexelWords> words(image.pixels());
  struct Known {
    Color color;
    TexelWords words;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, words.size(), 1 << 20), [&](const auto& range) {
    std::vector<Known> known(std::min(std::bit_ceil(range.size()), std::size_t{1} << 16),
                             Known{Color{-1, -1, -1}, {}});  // colours of spectra are not negative
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      const Color c = color_at(image, p);
      if (format == TexelFormat::number) {
        words[p] = {std::bit_cast<std::uint32_t>(c[0])};
      } else if (format <= TexelFormat::vector_float) {
        words[p] = vector_words(c, format);
      } else {
        std::uint32_t hash = 0;
        for (const float v : c) hash = (hash ^ std::bit_cast<std::uint32_t>(v)) * 0x9e3779b1u;
        Known& k = known[hash >> 16 & (known.size() - 1)];
        if (k.color != c) k = {c, spectral_words(c, format, fitter)};
        words[p] = k.words;
      }
    }
  });
  return words;
}

}  // namespace

Image halved(const Image& image) {
  const auto channels = static_cast<std::ptrdiff_t>(image.channels);
  Image narrow = black_image(std::max(1, image.width / 2), image.height, image.channels);
  for (int y = 0; y < image.height; ++y)
    for (std::ptrdiff_t c = 0; c < channels; ++c)
      halve(&image.values[static_cast<std::size_t>(y * image.width * channels + c)], image.width, channels,
            &narrow.values[static_cast<std::size_t>(y * narrow.width * channels + c)], channels);
  Image small = black_image(narrow.width, std::max(1, image.height / 2), image.channels);
  const std::ptrdiff_t row = narrow.width * channels;
  for (std::ptrdiff_t x = 0; x < row; ++x)
    halve(&narrow.values[static_cast<std::size_t>(x)], image.height, row,
          &small.values[static_cast<std::size_t>(x)], row);
  return small;
}

WrittenTextureFile write_baked_image(const std::filesystem::path& file, Image values, TextureUse use,
                                     bool all_levels, const ReflectanceFitter& fitter) {
  const bool spectral = use != TextureUse::number && use != TextureUse::vector;
  const float most = use == TextureUse::reflectance ? 1 : std::numeric_limits<float>::max();
  for (float& v : values.values) {
    if (!std::isfinite(v)) v = 0;
    if (spectral) v = std::clamp(v, 0.0f, most);
  }
  const auto width = static_cast<std::uint32_t>(values.width);
  const auto height = static_cast<std::uint32_t>(values.height);
  const TextureFileInfo info{format_for(values, use), width, height,
                             all_levels ? texture_level_count(width, height) : 1};
  std::vector<std::vector<TexelWords>> words;
  for (std::uint32_t level = 0; level < info.levels; ++level) {
    if (level > 0) values = halved(values);
    words.push_back(words_of(values, info.format, fitter));
  }
  return write_texture_file(file, info, [&](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
    const std::size_t w = std::max(width >> level, 1u), h = std::max(height >> level, 1u);
    return words[level][(h - 1 - y) * w + x];
  });
}

}  // namespace vitrail
