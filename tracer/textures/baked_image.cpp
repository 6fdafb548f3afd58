// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/baked_image.h"

#include <algorithm>
#include <cmath>

#include "tracer/textures/texel_value.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail {

namespace {

// floor without a call of the C library, for |x| < 2³¹.
int floor_to_int(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

// s or t where the image is repeated, so that what follows fits an int; beyond, in [-1, 2].
double folded(double s, Wrap wrap) {
  if (!(std::abs(s) < 1e9)) {
    if (!std::isfinite(s)) return 0;
    if (wrap == Wrap::repeat) return s - std::floor(s);
    if (wrap == Wrap::mirror) return s - 2 * std::floor(s / 2);
  }
  if (wrap == Wrap::repeat) return s - floor_to_int(s);
  if (wrap == Wrap::mirror) return s - 2.0 * floor_to_int(s / 2);
  return std::clamp(s, -1.0, 2.0);
}

// The texel that stands for texel i of a row of n, or −1 for black.
int wrapped(int i, int n, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return i < 0 ? i + n : i >= n ? i - n : i;
    case Wrap::mirror:
      if (i < 0) return -1 - i;
      if (i >= 2 * n) return i - 2 * n;
      return i >= n ? 2 * n - 1 - i : i;
    case Wrap::clamp:
      return std::clamp(i, 0, n - 1);
    default:
      return i < 0 || i >= n ? -1 : i;
  }
}

// The two texels of a row around a coordinate, and their weights: 0 for black ones, which any texel stands
// for.
struct Pair {
  std::array<std::uint32_t, 2> texel;
  std::array<float, 2> weight;
};
Pair pair_at(double s, int n, Wrap wrap) {
  const double x = folded(s, wrap) * n - 0.5;
  const int below = floor_to_int(x);
  const int i = wrapped(below, n, wrap), j = wrapped(below + 1, n, wrap);
  const auto f = static_cast<float>(x - below);
  return {{static_cast<std::uint32_t>(i < 0 ? 0 : i), static_cast<std::uint32_t>(j < 0 ? 0 : j)},
          {i < 0 ? 0 : 1 - f, j < 0 ? 0 : f}};
}

int single_at(double s, int n, Wrap wrap) { return wrapped(floor_to_int(folded(s, wrap) * n), n, wrap); }

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

  // Calls add(words, weight) for the texels around (s,t).
  template <class Add>
  void blend(double s, double t, Wrap wrap, int level, Add&& add) const {
    const Pair h = pair_at(s, static_cast<int>(levels[level].width), wrap);
    const Pair v = pair_at(t, static_cast<int>(levels[level].height), wrap);
    std::array<TexelWords, 4> words;
    read(level, h.texel, v.texel, words);
    for (std::size_t i = 0; i < 4; ++i) add(words[i], h.weight[i % 2] * v.weight[i / 2]);
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
  const NodeWeights weights(wavelengths, image.format);
  SampledSpectrum sum;
  image.blend(s, t, wrap, level, [&](const TexelWords& words, float weight) {
    add_texel(image.format, words, weights, weight, sum);
  });
  return image.lit(sum, wavelengths);
}

std::array<double, 3> BakedImage::nearest_vector(double s, double t, Wrap wrap, int level) const {
  const int x = single_at(s, width(level), wrap), y = single_at(t, height(level), wrap);
  if (x < 0 || y < 0) return {};
  return vector_of(format(), implementation_->one(x, y, level));
}

std::array<double, 3> BakedImage::bilinear_vector(double s, double t, Wrap wrap, int level) const {
  std::array<double, 3> sum{};
  implementation_->blend(s, t, wrap, level, [&](const TexelWords& words, float weight) {
    const std::array<double, 3> value = vector_of(implementation_->format, words);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += value[i] * static_cast<double>(weight);
  });
  return sum;
}

namespace {

// ∫ S·D65·ȳ dλ / ∫ D65·ȳ dλ as Σ share·S at five wavelengths: each stands for its surroundings.
struct LuminanceRule {
  static constexpr std::array<int, 5> lambda_nm{470, 515, 555, 595, 640};
  std::array<double, 5> share{};
  std::array<NodeWeights, 2> weights;

  explicit LuminanceRule(TexelFormat format) : weights{at(lambda_nm[0], format), at(lambda_nm[4], format)} {
    double total = 0;
    for (std::size_t i = 0; i < table_size; ++i) {
      const double w = static_cast<double>(cie_d65()[i]) * static_cast<double>(cie_1931()[i][1]);
      const int lambda = static_cast<int>(lambda_min_nm) + static_cast<int>(i);
      std::size_t nearest = 0;
      while (nearest < 4 && 2 * lambda > lambda_nm[nearest] + lambda_nm[nearest + 1]) ++nearest;
      share[nearest] += w;
      total += w;
    }
    for (double& s : share) s /= total;
  }
  double operator()(TexelFormat format, const TexelWords& words) const {
    const SampledSpectrum first = spectrum_of(format, words, weights[0]);
    double sum = share[4] * static_cast<double>(spectrum_of(format, words, weights[1]).v[0]);
    for (std::size_t i = 0; i < hero_count; ++i) sum += share[i] * static_cast<double>(first.v[i]);
    return std::max(sum, 0.0);
  }

 private:
  static NodeWeights at(int lambda, TexelFormat format) {
    SampledWavelengths w;
    if (lambda == lambda_nm[4])
      w.lambda_nm.fill(static_cast<float>(lambda));
    else
      for (std::size_t i = 0; i < hero_count; ++i) w.lambda_nm[i] = static_cast<float>(lambda_nm[i]);
    return NodeWeights(w, format);
  }
};

}  // namespace

double BakedImage::luminance(int x, int y, int level) const {
  static const LuminanceRule sigmoids(TexelFormat::reflectance), matrix_r(TexelFormat::matrix_r_reflectance);
  return (by_matrix_r(format()) ? matrix_r : sigmoids)(format(), implementation_->one(x, y, level));
}

}  // namespace vitrail
