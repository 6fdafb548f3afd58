// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/baked_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tracer/textures/texel_places.h"
#include "tracer/textures/texel_value.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail {

namespace {

constexpr int shift_of(std::uint32_t size) { return std::countr_zero(size); }

}  // namespace

struct BakedImage::Implementation {
  Implementation(TextureFile opened, std::shared_ptr<TileCache> tiles)
      : file(std::move(opened)),
        cache(std::move(tiles)),
        entries(std::make_unique<TileCache::Entry[]>(file.layout().tiles)),
        levels(file.layout().levels.data()),
        format(file.info().format),
        shift_x(shift_of(tile_width(format))),
        shift_y(shift_of(tile_height(format))) {}

  // Texels x[i % 2], y[i / 2] for i in [0, 4), which often lie in one tile.
  void read(int level, const std::array<std::uint32_t, 2>& x, const std::array<std::uint32_t, 2>& y,
            std::array<TexelWords, 4>& words) const {
    const TextureLevel& of = levels[level];
    if (((x[0] ^ x[1]) >> shift_x | (y[0] ^ y[1]) >> shift_y) != 0) {
      for (std::size_t i = 0; i < 4; ++i) words[i] = one(x[i % 2], y[i / 2], level);
      return;
    }
    const std::uint32_t tile_x = x[0] >> shift_x, tile_y = y[0] >> shift_y;
    const std::uint32_t first_x = tile_x << shift_x, first_y = tile_y << shift_y;
    const std::uint32_t row = std::min(1u << shift_x, of.width - first_x);
    const std::uint32_t row0 = (y[0] - first_y) * row, row1 = (y[1] - first_y) * row;
    const std::array<std::uint32_t, 4> index{row0 + x[0] - first_x, row0 + x[1] - first_x,
                                             row1 + x[0] - first_x, row1 + x[1] - first_x};
    read_tile(level, tile_x, tile_y, index, words.data());
  }

  TexelWords one(std::uint32_t x, std::uint32_t y, int level) const {
    const std::uint32_t tile_x = x >> shift_x, tile_y = y >> shift_y;
    const std::uint32_t first_x = tile_x << shift_x, first_y = tile_y << shift_y;
    const std::uint32_t row = std::min(1u << shift_x, levels[level].width - first_x);
    const std::array<std::uint32_t, 1> index{(y - first_y) * row + x - first_x};
    TexelWords words;
    read_tile(level, tile_x, tile_y, index, &words);
    return words;
  }
  TexelWords one(int x, int y, int level) const {
    return one(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), level);
  }

  template <std::size_t N>
  void read_tile(int level, std::uint32_t tile_x, std::uint32_t tile_y,
                 const std::array<std::uint32_t, N>& index, TexelWords* words) const {
    const TextureLevel& of = levels[level];
    const std::uint64_t tile = of.first_tile + static_cast<std::uint64_t>(tile_y) * of.tiles_x + tile_x;
    cache->read({file, entries[tile], format, static_cast<std::uint32_t>(level), tile_x, tile_y}, index,
                words);
  }

  // The texels around (s,t), and their weights.
  struct Blend {
    std::array<TexelWords, 4> texels;
    std::array<float, 4> weights;
  };
  Blend blend(double s, double t, Wrap wrap, int level) const {
    const TexelPair h = pair_at(s, static_cast<int>(levels[level].width), wrap);
    const TexelPair v = pair_at(t, static_cast<int>(levels[level].height), wrap);
    Blend of;
    read(level, h.texel, v.texel, of.texels);
    for (std::size_t i = 0; i < 4; ++i) of.weights[i] = h.weight[i % 2] * v.weight[i / 2];
    return of;
  }

  SampledSpectrum lit(const SampledSpectrum& value, const SampledWavelengths& wavelengths) const {
    return is_illuminant(format) ? value * d65_at(wavelengths) : value;
  }

  TextureFile file;
  std::shared_ptr<TileCache> cache;
  std::unique_ptr<TileCache::Entry[]> entries;  // a tile
  const TextureLevel* levels;
  TexelFormat format;
  int shift_x, shift_y;  // of a tile's size
};

BakedImage::BakedImage(const std::filesystem::path& file, std::shared_ptr<TileCache> cache)
    : BakedImage(TextureFile(file), std::move(cache)) {}
BakedImage::BakedImage(TextureFile file, std::shared_ptr<TileCache> cache)
    : implementation_(std::make_unique<Implementation>(std::move(file), std::move(cache))) {}
BakedImage::~BakedImage() = default;
BakedImage::BakedImage(BakedImage&&) noexcept = default;

const TextureFile& BakedImage::file() const { return implementation_->file; }
int BakedImage::width(int level) const {
  return static_cast<int>(file().layout().levels.at(static_cast<std::size_t>(level)).width);
}
int BakedImage::height(int level) const {
  return static_cast<int>(file().layout().levels.at(static_cast<std::size_t>(level)).height);
}

SampledSpectrum BakedImage::texel(int x, int y, int level, const SampledWavelengths& wavelengths) const {
  const Implementation& image = *implementation_;
  return image.lit(spectrum_of(image.format, image.one(x, y, level), NodeWeights(wavelengths, image.format)),
                   wavelengths);
}

SampledSpectrum BakedImage::nearest(double s, double t, Wrap wrap, int level,
                                    const SampledWavelengths& wavelengths) const {
  const int x = single_at(s, width(level), wrap), y = single_at(t, height(level), wrap);
  return x < 0 || y < 0 ? SampledSpectrum{} : texel(x, y, level, wavelengths);
}

SampledSpectrum BakedImage::bilinear(double s, double t, Wrap wrap, int level,
                                     const SampledWavelengths& wavelengths) const {
  const Implementation& image = *implementation_;
  const auto [texels, factors] = image.blend(s, t, wrap, level);
  return image.lit(sum_of(image.format, texels, factors, NodeWeights(wavelengths, image.format)),
                   wavelengths);
}

std::array<double, 3> BakedImage::nearest_vector(double s, double t, Wrap wrap, int level) const {
  const int x = single_at(s, width(level), wrap), y = single_at(t, height(level), wrap);
  if (x < 0 || y < 0) return {};
  return vector_of(format(), implementation_->one(x, y, level));
}

std::array<double, 3> BakedImage::bilinear_vector(double s, double t, Wrap wrap, int level) const {
  const auto [texels, weights] = implementation_->blend(s, t, wrap, level);
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::array<double, 3> value = vector_of(implementation_->format, texels[k]);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += value[i] * static_cast<double>(weights[k]);
  }
  return sum;
}

namespace {

// ∫ S·D65·ȳ dλ / ∫ D65·ȳ dλ as Σ share·S at the middles of bands of equal share: within 1e-3 for sigmoids.
class LuminanceRule {
 public:
  explicit LuminanceRule(TexelFormat format) {
    std::array<double, table_size> sums{};
    double total = 0;
    for (std::size_t i = 0; i < table_size; ++i)
      sums[i] = total += static_cast<double>(cie_d65()[i]) * static_cast<double>(cie_1931()[i][1]);
    for (std::size_t group = 0; group < groups; ++group) {
      SampledWavelengths w;
      for (std::size_t i = 0; i < hero_count; ++i) {
        const double middle =
            total * (static_cast<double>(group * hero_count + i) + 0.5) / (groups * hero_count);
        const auto above = std::ranges::lower_bound(sums, middle);  // not the first: the bands are wider
        const double into_nm = (middle - *(above - 1)) / (*above - *(above - 1)) - 0.5;
        w.lambda_nm[i] =
            static_cast<float>(lambda_min_nm + static_cast<double>(above - sums.begin()) + into_nm);
      }
      weights_.emplace_back(w, format);
    }
  }
  double operator()(TexelFormat format, const TexelWords& words) const {
    double sum = 0;
    for (const NodeWeights& weights : weights_) {
      const SampledSpectrum values = spectrum_of(format, words, weights);
      for (std::size_t i = 0; i < hero_count; ++i) sum += static_cast<double>(values.v[i]);
    }
    return std::max(sum / (groups * hero_count), 0.0);
  }

 private:
  static constexpr std::size_t groups = 8;
  std::vector<NodeWeights> weights_;
};

}  // namespace

double BakedImage::number(int x, int y, int level) const {
  return vector_of(format(), implementation_->one(x, y, level))[0];
}

double BakedImage::luminance(int x, int y, int level) const {
  static const LuminanceRule sigmoids(TexelFormat::reflectance), matrix_r(TexelFormat::matrix_r_reflectance);
  return (by_matrix_r(format()) ? matrix_r : sigmoids)(format(), implementation_->one(x, y, level));
}

}  // namespace vitrail
