// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/baked_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bundle/reflectances/color_words.h"
#include "tracer/textures/image_lanes.h"
#include "tracer/textures/texel_value.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail {

namespace {

constexpr int shift_of(std::uint32_t size) { return std::countr_zero(size); }

auto one_lane(const SampledWavelengths& wavelengths) {
  return [&](int) __attribute__((always_inline))->const SampledWavelengths& { return wavelengths; };
}

}  // namespace

struct BakedImage::Implementation {
  Implementation(TextureFile opened, std::shared_ptr<TileCache> tiles)
      : file(std::move(opened)),
        cache(std::move(tiles)),
        entries(std::make_unique<TileCache::Entry[]>(file.layout().tiles)),
        levels(file.layout().levels.data()),
        format(read_format(file.info().format)),
        shift_x(shift_of(tile_width(format))),
        shift_y(shift_of(tile_height(format))) {}

  // Texels x[i % 2], y[i / 2] for i in [0, 4), which often lie in one tile.
  void read(int level, const std::array<std::uint32_t, 2>& x, const std::array<std::uint32_t, 2>& y,
            const TileCache::Words& words) const {
    const TextureLevel& of = levels[level];
    if (((x[0] ^ x[1]) >> shift_x | (y[0] ^ y[1]) >> shift_y) != 0) {
      for (std::size_t i = 0; i < 4; ++i)
        read_one(level, x[i % 2], y[i / 2], {words.first + 3 * i * words.stride, words.stride});
      return;
    }
    const std::uint32_t tile_x = x[0] >> shift_x, tile_y = y[0] >> shift_y;
    const std::uint32_t first_x = tile_x << shift_x, first_y = tile_y << shift_y;
    const std::uint32_t row = std::min(1u << shift_x, of.width - first_x);
    const std::uint32_t row0 = (y[0] - first_y) * row, row1 = (y[1] - first_y) * row;
    const std::array<std::uint32_t, 4> index{row0 + x[0] - first_x, row0 + x[1] - first_x,
                                             row1 + x[0] - first_x, row1 + x[1] - first_x};
    read_tile(level, tile_x, tile_y, index, words);
  }

  void read_one(int level, std::uint32_t x, std::uint32_t y, const TileCache::Words& words) const {
    const PlaceInTile at = place_in_tile(level, x, y);
    read_tile(level, at.tile_x, at.tile_y, at.index, words);
  }
  // Perhaps of a colour whose spectrum is still to be found.
  TexelWords one_as_kept(int x, int y, int level) const {
    const PlaceInTile at = place_in_tile(level, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    TexelWords words{};
    cache->read_as_kept(tile_at(level, at.tile_x, at.tile_y), at.index, {words.data()});
    return words;
  }
  TexelWords one(int x, int y, int level) const {
    TexelWords words;
    read_one(level, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {words.data()});
    return words;
  }

  template <std::size_t N>
  void read_tile(int level, std::uint32_t tile_x, std::uint32_t tile_y,
                 const std::array<std::uint32_t, N>& index, const TileCache::Words& words) const {
    cache->read(tile_at(level, tile_x, tile_y), index, words);
  }
  TileCache::Tile tile_at(int level, std::uint32_t tile_x, std::uint32_t tile_y) const {
    const TextureLevel& of = levels[level];
    const std::uint64_t tile = of.first_tile + static_cast<std::uint64_t>(tile_y) * of.tiles_x + tile_x;
    return {file, entries[tile], format, static_cast<std::uint32_t>(level), tile_x, tile_y};
  }
  struct PlaceInTile {
    std::uint32_t tile_x, tile_y;
    std::array<std::uint32_t, 1> index;
  };
  PlaceInTile place_in_tile(int level, std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t tile_x = x >> shift_x, tile_y = y >> shift_y;
    const std::uint32_t first_x = tile_x << shift_x, first_y = tile_y << shift_y;
    const std::uint32_t row = std::min(1u << shift_x, levels[level].width - first_x);
    return {tile_x, tile_y, {(y - first_y) * row + x - first_x}};
  }

  // The texels around (s,t), and their weights.
  struct Blend {
    std::array<TexelWords, 4> texels;
    std::array<float, 4> weights;
  };
  Blend blend(double s, double t, Wrap wrap, int level) const {
    const auto pair = [&](double at, std::uint32_t n) {
      return lanes::pair_at(at, static_cast<int>(n), wrap);
    };
    const lanes::TexelPair<double> h = pair(s, levels[level].width), v = pair(t, levels[level].height);
    const auto texels = [](const lanes::TexelPair<double>& of) {
      return std::array{static_cast<std::uint32_t>(of.texel[0]), static_cast<std::uint32_t>(of.texel[1])};
    };
    Blend of;
    read(level, texels(h), texels(v), {of.texels[0].data()});
    for (std::size_t i = 0; i < 4; ++i) of.weights[i] = h.weight[i % 2] * v.weight[i / 2];
    return of;
  }

  // By Matrix-R.
  SampledSpectrum sum(std::span<const TexelWords> texels, const float* factors,
                      const SampledWavelengths& wavelengths) const {
    SampledSpectrum value = sum_of(format, texels, factors, MatrixRWeights(wavelengths));
    if (is_illuminant(format))
      for (std::size_t i = 0; i < hero_count; ++i)
        value.v[i] *= lanes::table_value(cie_d65().data(), wavelengths.lambda_nm[i]);
    return value;
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

BakedImage::Size BakedImage::size(int level) const {
  const TextureLevel& of = implementation_->levels[level];
  return {implementation_->format, static_cast<int>(of.width), static_cast<int>(of.height)};
}

void BakedImage::read_corners(int level, unsigned lanes, int count, const std::int32_t* x,
                              const std::int32_t* y, std::uint32_t* words) const {
  const auto two = [count](const std::int32_t* at) {
    return std::array{static_cast<std::uint32_t>(at[0]), static_cast<std::uint32_t>(at[count])};
  };
  for (int j = 0; j < count; ++j)
    if (lanes >> j & 1)
      implementation_->read(level, two(x + j), two(y + j), {words + j, static_cast<std::size_t>(count)});
}

void BakedImage::read_texels(int level, unsigned lanes, int count, const std::int32_t* x,
                             const std::int32_t* y, std::uint32_t* words) const {
  for (int j = 0; j < count; ++j)
    if (lanes >> j & 1)
      implementation_->read_one(level, static_cast<std::uint32_t>(x[j]), static_cast<std::uint32_t>(y[j]),
                                {words + j, static_cast<std::size_t>(count)});
}

SampledSpectrum BakedImage::texel(int x, int y, int level, const SampledWavelengths& wavelengths) const {
  const Implementation& image = *implementation_;
  if (by_matrix_r(image.format)) {
    const TexelWords words = image.one(x, y, level);
    constexpr float whole = 1;
    return image.sum({&words, 1}, &whole, wavelengths);
  }
  return lanes::lane(lanes::texel(*this, x, y, level, 1u, one_lane(wavelengths)), 0);
}

SampledSpectrum BakedImage::nearest(double s, double t, Wrap wrap, int level,
                                    const SampledWavelengths& wavelengths) const {
  const Size of = size(level);
  const int x = lanes::single_at(s, of.width, wrap), y = lanes::single_at(t, of.height, wrap);
  return x < 0 || y < 0 ? SampledSpectrum{} : texel(x, y, level, wavelengths);
}

SampledSpectrum BakedImage::bilinear(double s, double t, Wrap wrap, int level,
                                     const SampledWavelengths& wavelengths) const {
  const Implementation& image = *implementation_;
  if (by_matrix_r(image.format)) {
    const auto [texels, factors] = image.blend(s, t, wrap, level);
    return image.sum(texels, factors.data(), wavelengths);
  }
  return lanes::lane(lanes::bilinear(*this, s, t, wrap, level, 1u, one_lane(wavelengths)), 0);
}

std::array<double, 3> BakedImage::nearest_vector(double s, double t, Wrap wrap, int level) const {
  const Size of = size(level);
  const int x = lanes::single_at(s, of.width, wrap), y = lanes::single_at(t, of.height, wrap);
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

SampledSpectrum values_at(TexelFormat format, const TexelWords& words,
                          const lanes::NodeWeights<float>& weights) {
  lanes::TexelsOfLanes<1, 1> texel{};
  for (std::size_t w = 0; w < words.size(); ++w) texel.word[0][w][0] = words[w];
  constexpr float whole[1] = {1};
  return lanes::lane(lanes::parted(lanes::sum_of<float>(format, texel, whole, weights)), 0);
}
SampledSpectrum values_at(TexelFormat format, const TexelWords& words, const MatrixRWeights& weights) {
  constexpr float whole = 1;
  return sum_of(format, {&words, 1}, &whole, weights);
}

// ∫ S·D65·ȳ dλ / ∫ D65·ȳ dλ as Σ share·S at the middles of bands of equal share: within 1e-3 for sigmoids.
template <class Weights>
class LuminanceRule {
 public:
  LuminanceRule() {
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
      weights_.push_back(weights_at(w));
    }
  }
  double operator()(TexelFormat format, const TexelWords& words) const {
    double sum = 0;
    for (const Weights& weights : weights_) {
      const SampledSpectrum values = values_at(format, words, weights);
      for (std::size_t i = 0; i < hero_count; ++i) sum += static_cast<double>(values.v[i]);
    }
    return std::max(sum / (groups * hero_count), 0.0);
  }

 private:
  static constexpr std::size_t groups = 8;
  static Weights weights_at(const SampledWavelengths& wavelengths) {
    if constexpr (std::is_same_v<Weights, MatrixRWeights>)
      return Weights(wavelengths);
    else
      return Weights(lanes::gather_wavelengths<float>(one_lane(wavelengths)));
  }
  std::vector<Weights> weights_;
};

}  // namespace

double BakedImage::number(int x, int y, int level) const {
  return vector_of(format(), implementation_->one(x, y, level))[0];
}

double BakedImage::luminance(int x, int y, int level) const {
  static const LuminanceRule<lanes::NodeWeights<float>> sigmoids;
  static const LuminanceRule<MatrixRWeights> matrix_r;
  const TextureFile& of = file();
  const TexelWords kept = implementation_->one_as_kept(x, y, level);
  if (const auto color = coded_color(of.info().format, kept, of.values()))
    return srgb_to_xyz({static_cast<double>((*color)[0]), static_cast<double>((*color)[1]),
                        static_cast<double>((*color)[2])})
        .y;
  const TexelWords words = implementation_->one(x, y, level);
  if (format() == TexelFormat::bands) {
    const std::array<double, 3> c = vector_of(TexelFormat::vector_float, words);
    return srgb_to_xyz({c[0], c[1], c[2]}).y;
  }
  return by_matrix_r(format()) ? matrix_r(format(), words) : sigmoids(format(), words);
}

}  // namespace vitrail
