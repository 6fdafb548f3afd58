// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_codes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bundle/texture_writer.h"
#include "images/texture_values.h"
#include "partitioner/appearance/row_pyramid.h"

namespace vitrail {

namespace {

// What the texture makes of each byte, in the channel that counts.
CodeValues values_of_bytes(const ImageTexture& texture, TextureUse use) {
  const bool number = use == TextureUse::number;
  StoredImage ramp{black_image(code_count, 1, number ? 1 : 3), true, {}};
  const auto channels = static_cast<std::size_t>(ramp.image.channels);
  for (std::size_t i = 0; i < ramp.image.values.size(); ++i) {
    const std::size_t code = i / channels;
    ramp.image.values[i] = static_cast<float>(code) * (1.0f / (code_count - 1));  // as the library has it
  }
  ImageTexture one = texture;
  if (number && one.number == ImageNumber::alpha) one.number = ImageNumber::mean;  // of the ramp
  const Image all = texture_values(one, std::move(ramp), number ? ImageUse::number : ImageUse::color);
  CodeValues values;
  for (std::size_t i = 0; i < all.values.size(); i += channels) values.push_back(all.values[i]);
  return values;
}

// The channel that a number is, if it is one.
std::optional<std::size_t> channel_of(ImageNumber number, int channels) {
  const bool grey = channels < 3;
  switch (number) {
    case ImageNumber::alpha:
      return channels % 2 == 0 ? std::optional(static_cast<std::size_t>(channels - 1)) : std::nullopt;
    case ImageNumber::red:
      return 0;
    case ImageNumber::green:
      return grey ? 0 : 1;
    case ImageNumber::blue:
      return grey ? 0 : 2;
    default:
      return grey ? std::optional<std::size_t>(0) : std::nullopt;
  }
}

bool has_only_greys(const ByteRows& rows) {
  if (rows.channels < 3) return true;
  struct Colored {};
  const auto step = static_cast<std::size_t>(rows.channels);
  try {
    rows.read([&](std::span<const std::uint8_t> bytes) {
      for (std::size_t at = 0; at < bytes.size(); at += step)
        if (bytes[at] != bytes[at + 1] || bytes[at] != bytes[at + 2]) throw Colored();
    });
  } catch (const Colored&) {
    return false;
  }
  return true;
}

// The code whose value is `value`, or one of the two around it: the greater as often as the value is near it.
// The thresholds are a sequence of low discrepancy in x and y (Roberts 2018, "R2").
std::uint8_t code_near(const CodeValues& values, float value, std::uint32_t x, std::uint32_t y,
                       std::size_t channel) {
  const auto above = std::ranges::lower_bound(values, value) - values.begin();
  const auto upper = static_cast<std::size_t>(std::min<std::ptrdiff_t>(above, code_count - 1));
  if (upper == 0 || values[upper] <= value) return static_cast<std::uint8_t>(upper);
  const double low = static_cast<double>(values[upper - 1]), high = static_cast<double>(values[upper]);
  const double at = 0.7548776662466927 * x + 0.5698402909980532 * y + static_cast<double>(channel) / 3 + 0.5;
  const bool greater = (static_cast<double>(value) - low) / (high - low) > at - std::floor(at);
  return static_cast<std::uint8_t>(greater ? upper : upper - 1);
}

// Writes the codes of the finest level as they come, and those of the others by their means.
class CodedLevels {
 public:
  CodedLevels(TextureWriter& writer, const TextureFileInfo& info, const CodeValues& values)
      : writer_(writer),
        values_(values),
        channels_(bytes_per_texel(info.format)),
        pyramid_(info, static_cast<int>(channels_),
                 [this](auto level, auto y, auto row) { add_means(level, y, row); }) {}

  void add_codes(std::span<const std::uint8_t> codes) {
    writer_.add_row(0, std::as_bytes(codes));
    decoded_.resize(codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i) decoded_[i] = values_[codes[i]];
    pyramid_.add(decoded_);
  }

 private:
  void add_means(std::uint32_t level, std::uint32_t y, std::span<const float> row) {
    std::vector<std::uint8_t> codes(row.size());
    for (std::size_t i = 0; i < row.size(); ++i)
      codes[i] = code_near(values_, row[i], static_cast<std::uint32_t>(i / channels_), y, i % channels_);
    writer_.add_row(level, std::as_bytes(std::span(codes)));
  }

  TextureWriter& writer_;
  const CodeValues& values_;
  std::size_t channels_;
  std::vector<float> decoded_;
  RowPyramid pyramid_;
};

}  // namespace

std::optional<CodedImage> coded_image(const ImageTexture& texture, const ByteRows& rows, TextureUse use,
                                      RgbMethod method) {
  if (use == TextureUse::vector) return {};
  CodedImage coded{TexelFormat::color_code, 0, values_of_bytes(texture, use)};
  const bool color = use != TextureUse::number;
  for (float& v : coded.values) {
    if (!std::isfinite(v)) return {};
    if (color) v = std::max(v, 0.0f);
    if (use == TextureUse::reflectance) v = std::min(v, 1.0f);
  }
  if (!std::ranges::is_sorted(coded.values)) return {};
  if (!color) {
    const auto channel = channel_of(texture.number, rows.channels);
    if (!channel) return {};
    coded.format = TexelFormat::number_code, coded.first_channel = *channel;
  } else if (method == RgbMethod::bands) {
    coded.format = has_only_greys(rows) ? TexelFormat::number_code : TexelFormat::band_code;
  } else if (use == TextureUse::illuminant) {
    if (method == RgbMethod::matrix_r) return {};
    coded.format = TexelFormat::light_code;
  } else if (has_only_greys(rows)) {
    coded.format = TexelFormat::number_code;
  } else if (coded.values.back() > 1 || method == RgbMethod::matrix_r) {
    return {};
  }
  return coded;
}

WrittenTextureFile write_coded_image(const std::filesystem::path& file, const ByteRows& rows,
                                     const CodedImage& coded, bool all_levels) {
  const auto width = static_cast<std::uint32_t>(rows.width), height = static_cast<std::uint32_t>(rows.height);
  const TextureFileInfo info{coded.format, width, height,
                             all_levels ? texture_level_count(width, height) : 1};
  TextureWriter writer(file, info, coded.values);
  CodedLevels levels(writer, info, coded.values);
  const auto step = static_cast<std::size_t>(rows.channels), row = step * width;
  const std::size_t taken = bytes_per_texel(coded.format);
  std::vector<std::uint8_t> codes(width * taken);
  rows.read([&](std::span<const std::uint8_t> bytes) {
    for (; !bytes.empty(); bytes = bytes.subspan(row)) {
      if (step == taken) {
        levels.add_codes(bytes.first(row));
        continue;
      }
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < taken; ++c)
          codes[x * taken + c] = bytes[x * step + coded.first_channel + (step < 3 ? 0 : c)];
      levels.add_codes(codes);
    }
  });
  return writer.finish();
}

}  // namespace vitrail
