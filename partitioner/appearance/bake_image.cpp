// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_image.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "bundle/reflectances/reflectance_table.h"
#include "bundle/texture_writer.h"
#include "partitioner/appearance/bake_light_codes.h"
#include "partitioner/appearance/row_halver.h"
#include "scene/spectra/matrix_r.h"

namespace vitrail {

namespace {

using Color = std::array<float, 3>;

Color color_at(const Image& image, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const float* const value = &image.values[pixel * channels];
  if (channels < 3) return {value[0], value[0], value[0]};
  return {value[0], value[1], value[2]};
}

bool are_multiples(const Image& image, double of) {
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

// What all rows of an image have in common.
struct Survey {
  bool grey = true, of_255 = true, of_65535 = true;
  float greatest = 0;

  // Whether more rows change no format.
  bool is_settled(TextureUse use) const {
    if (use == TextureUse::vector) return !of_255 && !of_65535;
    return !grey && (use != TextureUse::unbounded || greatest > 1);
  }

  void add(const Image& image, TextureUse use) {
    if (use == TextureUse::vector) {
      of_255 = of_255 && are_multiples(image, 255);
      of_65535 = of_65535 && are_multiples(image, 65535);
    } else {
      grey = grey && is_grey(image);
      greatest = std::max(greatest, *std::max_element(image.values.begin(), image.values.end()));
    }
  }
};

TexelFormat format_for(const Survey& all, TextureUse use, RgbMethod method) {
  if (use == TextureUse::number) return TexelFormat::number;
  if (use == TextureUse::vector)
    return all.of_255     ? TexelFormat::vector_8
           : all.of_65535 ? TexelFormat::vector_16
                          : TexelFormat::vector_float;
  if (method == RgbMethod::bands) return all.grey ? TexelFormat::number : TexelFormat::bands;
  const bool matrix_r = method == RgbMethod::matrix_r && !all.grey;
  if (use == TextureUse::illuminant)
    return matrix_r ? TexelFormat::matrix_r_illuminant : TexelFormat::illuminant;
  if (all.grey) return TexelFormat::number;
  if (use == TextureUse::reflectance || all.greatest <= 1)
    return matrix_r ? TexelFormat::matrix_r_reflectance : TexelFormat::reflectance;
  return matrix_r ? TexelFormat::matrix_r_unbounded : TexelFormat::unbounded;
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

// As matrix_r_reflectance.
TexelWords matrix_r_words(const Color& c, TexelFormat format) {
  const RGB color{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  const double scale =
      format == TexelFormat::matrix_r_reflectance ? 1 : 2 * std::max({color.r, color.g, color.b});
  if (!(scale > 0)) return pack({{}, 0});
  const MatrixRReflectance s = matrix_r_weights({color.r / scale, color.g / scale, color.b / scale});
  const double largest = std::max({std::abs(s.weights[0]), std::abs(s.weights[1]), std::abs(s.weights[2])});
  const double within = std::min(1.0, static_cast<double>(real21_max) / std::max(largest, 1.0));
  SpectralTexel texel;
  for (std::size_t i = 0; i < 3; ++i) texel.x[i] = static_cast<float>(s.weights[i] * within);
  if (format == TexelFormat::matrix_r_reflectance)
    texel.scale = static_cast<float>(s.part);
  else
    texel.scale = static_cast<float>(largest > 0 ? scale : scale * (1 - s.part));
  return pack(texel);
}

// What the components are divided by, as in unbounded_from_rgb and emission_from_rgb.
float scale_of(const Color& c, TexelFormat format) {
  const float greatest = std::max({c[0], c[1], c[2]});
  const bool scaled = format == TexelFormat::illuminant || (format == TexelFormat::unbounded && greatest > 1);
  return scaled ? 2 * greatest : 1;
}

TexelWords fitted_words(const Color& c, TexelFormat format, const ReflectanceFitter& fitter) {
  if (by_matrix_r(format)) return matrix_r_words(c, format);
  const double scale = static_cast<double>(scale_of(c, format));
  if (!(scale > 0)) return pack({{}, 0});
  return pack({fitter({static_cast<double>(c[0]) / scale, static_cast<double>(c[1]) / scale,
                       static_cast<double>(c[2]) / scale}),
               static_cast<float>(scale)});
}

// Makes the words of texels. What is fitted comes again, among neighbours and in coarser levels.
class TexelMaker {
 public:
  TexelMaker(const TextureFileInfo& info, const ReflectanceFitter& fitter)
      : format_(info.format),
        fitter_(fitter),
        most_known_(std::bit_ceil(std::min<std::size_t>(std::size_t{info.width} * info.height, 1 << 16))) {}

  // Of all pixels, in the order of the image.
  std::vector<TexelWords> words_of(const Image& image) {
    std::vector<TexelWords> words(image.pixels());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, words.size(), 1 << 14), [&](const auto& range) {
      std::vector<Known>& known = known_.local();
      known.resize(most_known_);
      if (format_ <= TexelFormat::vector_float || format_ >= TexelFormat::matrix_r_reflectance)
        for (std::size_t p = range.begin(); p != range.end(); ++p) words[p] = word(color_at(image, p), known);
      else
        for (std::size_t p = range.begin(); p < range.end(); p += reflectance_batch)
          sigmoid_words(image, p, std::min(p + reflectance_batch, range.end()), words, known);
    });
    return words;
  }

 private:
  struct Known {
    Color color{-1, -1, -1};  // colours of spectra are not negative
    TexelWords words{};
  };

  TexelWords word(const Color& c, std::vector<Known>& known) const {
    if (format_ == TexelFormat::number) return {std::bit_cast<std::uint32_t>(c[0])};
    if (format_ <= TexelFormat::vector_float) return vector_words(c, format_);
    if (format_ == TexelFormat::bands) return vector_words(c, TexelFormat::vector_float);
    std::uint32_t hash = 0;
    for (const float v : c) hash = (hash ^ std::bit_cast<std::uint32_t>(v)) * 0x9e3779b1u;
    Known& k = known[hash >> 16 & (most_known_ - 1)];
    if (k.color != c) k = {c, fitted_words(c, format_, fitter_)};
    return k.words;
  }

  // Of at most reflectance_batch pixels.
  void sigmoid_words(const Image& image, std::size_t first, std::size_t end, std::vector<TexelWords>& words,
                     std::vector<Known>& known) const {
    std::array<Color, reflectance_batch> colors, scaled;
    std::array<float, reflectance_batch> scales;
    std::array<std::optional<SigmoidNodes>, reflectance_batch> nodes;
    const std::size_t count = end - first;
    for (std::size_t l = 0; l < count; ++l) {
      colors[l] = color_at(image, first + l);
      scales[l] = scale_of(colors[l], format_);
      for (std::size_t k = 0; k < 3; ++k) scaled[l][k] = colors[l][k] / scales[l];
    }
    tabulated_reflectances({scaled.data(), count}, {nodes.data(), count});
    for (std::size_t l = 0; l < count; ++l)
      words[first + l] = nodes[l] ? pack({*nodes[l], scales[l]}) : word(colors[l], known);
  }

  TexelFormat format_;
  const ReflectanceFitter& fitter_;
  std::size_t most_known_;
  tbb::enumerable_thread_specific<std::vector<Known>> known_;
};

// Each level takes the rows of its image from the top, and hands those of the next one on.
class Levels {
 public:
  Levels(TextureWriter& writer, const TextureFileInfo& info, const ReflectanceFitter& fitter)
      : writer_(writer), info_(info), maker_(info, fitter), pending_(info.levels) {}

  void add(std::uint32_t level, const Image& rows) {
    const auto width = static_cast<std::size_t>(rows.width);
    const std::vector<TexelWords> words = maker_.words_of(rows);
    for (std::size_t at = 0; at < words.size(); at += width)
      writer_.add_row(level, std::span(words).subspan(at, width));
    if (level + 1 == info_.levels) return;
    if (halvers_.size() <= level)
      halvers_.emplace_back(rows.width, static_cast<int>(std::max(info_.height >> level, 1u)), rows.channels);
    const std::size_t stride = width * static_cast<std::size_t>(rows.channels);
    for (std::size_t at = 0; at < rows.values.size(); at += stride)
      halvers_[level].add(std::span(rows.values).subspan(at, stride),
                          [&](std::span<const float> half) { collect(level + 1, half, rows.channels); });
  }

  // After the last row.
  void flush() {
    for (std::uint32_t level = 1; level < info_.levels; ++level) flush(level);
  }

 private:
  // Rows of enough pixels for all threads.
  void collect(std::uint32_t level, std::span<const float> row, int channels) {
    constexpr std::size_t enough = 1 << 18;
    Image& rows = pending_[level];
    rows.width = static_cast<int>(row.size()) / channels;
    rows.channels = channels;
    ++rows.height;
    rows.values.insert(rows.values.end(), row.begin(), row.end());
    if (rows.values.size() >= enough) flush(level);
  }
  void flush(std::uint32_t level) {
    const Image rows = std::exchange(pending_[level], {0, 0, 0, {}});
    if (rows.height > 0) add(level, rows);
  }

  TextureWriter& writer_;
  TextureFileInfo info_;
  TexelMaker maker_;
  std::vector<Image> pending_;     // of each level
  std::deque<RowHalver> halvers_;  // of each level but the last; they stay where they are
};

// What of the values counts.
Image sane(Image values, TextureUse use) {
  const bool spectral = use != TextureUse::number && use != TextureUse::vector;
  const float most = use == TextureUse::reflectance ? 1 : std::numeric_limits<float>::max();
  for (float& v : values.values) {
    if (!std::isfinite(v)) v = 0;
    if (spectral) v = std::clamp(v, 0.0f, most);
  }
  return values;
}

// Reads no further than it has to.
Survey survey_of(const ImageRows& rows, TextureUse use) {
  struct Settled {};
  Survey survey;
  try {
    rows.read([&](Image values) {
      survey.add(sane(std::move(values), use), use);
      if (survey.is_settled(use)) throw Settled();
    });
  } catch (const Settled&) {
  }
  return survey;
}

}  // namespace

WrittenTextureFile write_baked_image(const std::filesystem::path& file, const ImageRows& rows, TextureUse use,
                                     bool all_levels, const ReflectanceFitter& fitter, RgbMethod method) {
  if (use == TextureUse::illuminant && method == RgbMethod::jakob_hanika)
    if (const auto written = write_light_codes(file, rows, all_levels)) return *written;
  const Survey survey = use == TextureUse::number ? Survey{} : survey_of(rows, use);
  const auto width = static_cast<std::uint32_t>(rows.width), height = static_cast<std::uint32_t>(rows.height);
  const TextureFileInfo info{format_for(survey, use, method), width, height,
                             all_levels ? texture_level_count(width, height) : 1};
  TextureWriter writer(file, info);
  Levels levels(writer, info, fitter);
  rows.read([&](Image values) { levels.add(0, sane(std::move(values), use)); });
  levels.flush();
  return writer.finish();
}

}  // namespace vitrail
