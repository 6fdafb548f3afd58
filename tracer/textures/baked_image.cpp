// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/baked_image.h"

#include <algorithm>
#include <cmath>

#include "tracer/textures/texel_value.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail {

namespace {

// s or t where the image is repeated, so that what follows fits an int; beyond, in [-1, 2].
double folded(double s, Wrap wrap) {
  if (!std::isfinite(s)) return 0;
  if (wrap == Wrap::repeat) return s - std::floor(s);
  if (wrap == Wrap::mirror) return s - 2 * std::floor(s / 2);
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

// The two texels of a row around a coordinate; weight of the second.
struct Pair {
  int first, second;
  float weight;
};
Pair pair_at(double s, int n, Wrap wrap) {
  const double x = folded(s, wrap) * n - 0.5;
  const double below = std::floor(x);
  const int i = static_cast<int>(below);
  return {wrapped(i, n, wrap), wrapped(i + 1, n, wrap), static_cast<float>(x - below)};
}

int single_at(double s, int n, Wrap wrap) {
  return wrapped(static_cast<int>(std::floor(folded(s, wrap) * n)), n, wrap);
}

}  // namespace

struct BakedImage::Implementation {
  Implementation(TextureFile opened, std::shared_ptr<TileCache> tiles)
      : file(std::move(opened)),
        cache(std::move(tiles)),
        entries(std::make_unique<TileCache::Entry[]>(file.layout().tiles)),
        format(file.info().format) {}

  // Texels (x[i], y[i]) of one tile, or of as many as there are.
  void read(int level, const std::array<int, 4>& x, const std::array<int, 4>& y, int count,
            std::array<TexelWords, 4>& out) const {
    const TextureLevel& of = file.layout().levels[static_cast<std::size_t>(level)];
    const std::uint32_t tile_w = tile_width(format), tile_h = tile_height(format);
    std::array<std::uint32_t, 4> tile, index, tile_x, tile_y;
    bool same = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto tx = static_cast<std::uint32_t>(x[i]), ty = static_cast<std::uint32_t>(y[i]);
      tile_x[i] = tx / tile_w, tile_y[i] = ty / tile_h;
      tile[i] = tile_y[i] * of.tiles_x + tile_x[i];
      const std::uint32_t row = std::min(tile_w, of.width - tile_x[i] * tile_w);
      index[i] = (ty - tile_y[i] * tile_h) * row + (tx - tile_x[i] * tile_w);
      same = same && tile[i] == tile[0];
    }
    const auto from_tile = [&](std::size_t i, std::size_t n) {
      cache->read(
          {file, entries[of.first_tile + tile[i]], static_cast<std::uint32_t>(level), tile_x[i], tile_y[i]},
          std::span(index).subspan(i, n), &out[i]);
    };
    if (same) return from_tile(0, static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) from_tile(i, 1);
  }

  // Calls add(words, weight) for the texels around (s,t) that are not black.
  template <class Add>
  void blend(double s, double t, Wrap wrap, int level, Add&& add) const {
    const TextureLevel& of = file.layout().levels[static_cast<std::size_t>(level)];
    const Pair h = pair_at(s, static_cast<int>(of.width), wrap);
    const Pair v = pair_at(t, static_cast<int>(of.height), wrap);
    std::array<int, 4> x{h.first, h.second, h.first, h.second}, y{v.first, v.first, v.second, v.second};
    std::array<float, 4> weight{(1 - h.weight) * (1 - v.weight), h.weight * (1 - v.weight),
                                (1 - h.weight) * v.weight, h.weight * v.weight};
    int count = 4;
    if (wrap == Wrap::black) {
      count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (x[i] < 0 || y[i] < 0) continue;
        const auto to = static_cast<std::size_t>(count++);
        x[to] = x[i], y[to] = y[i], weight[to] = weight[i];
      }
      if (count == 0) return;
    }
    std::array<TexelWords, 4> words;
    read(level, x, y, count, words);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) add(words[i], weight[i]);
  }

  TexelWords one(int x, int y, int level) const {
    std::array<TexelWords, 4> words;
    read(level, {x}, {y}, 1, words);
    return words[0];
  }

  SampledSpectrum lit(const SampledSpectrum& value, const SampledWavelengths& wavelengths) const {
    return format == TexelFormat::illuminant ? value * d65_at(wavelengths) : value;
  }

  TextureFile file;
  std::shared_ptr<TileCache> cache;
  std::unique_ptr<TileCache::Entry[]> entries;  // a tile
  TexelFormat format;
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
  return image.lit(spectrum_of(image.format, image.one(x, y, level), NodeWeights(wavelengths)), wavelengths);
}

SampledSpectrum BakedImage::nearest(double s, double t, Wrap wrap, int level,
                                    const SampledWavelengths& wavelengths) const {
  const int x = single_at(s, width(level), wrap), y = single_at(t, height(level), wrap);
  return x < 0 || y < 0 ? SampledSpectrum{} : texel(x, y, level, wavelengths);
}

SampledSpectrum BakedImage::bilinear(double s, double t, Wrap wrap, int level,
                                     const SampledWavelengths& wavelengths) const {
  const Implementation& image = *implementation_;
  const NodeWeights weights(wavelengths);
  SampledSpectrum sum;
  image.blend(s, t, wrap, level, [&](const TexelWords& words, float weight) {
    sum = sum + spectrum_of(image.format, words, weights) * weight;
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
  std::array<NodeWeights, 2> weights{at(lambda_nm[0]), at(lambda_nm[4])};

  LuminanceRule() {
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
  static NodeWeights at(int lambda) {
    SampledWavelengths w;
    if (lambda == lambda_nm[4])
      w.lambda_nm.fill(static_cast<float>(lambda));
    else
      for (std::size_t i = 0; i < hero_count; ++i) w.lambda_nm[i] = static_cast<float>(lambda_nm[i]);
    return NodeWeights(w);
  }
};

}  // namespace

double BakedImage::luminance(int x, int y, int level) const {
  static const LuminanceRule rule;
  return rule(format(), implementation_->one(x, y, level));
}

}  // namespace vitrail
