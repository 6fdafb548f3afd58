// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/texture_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "images/ptex_means.h"
#include "images/texture_values.h"

namespace vitrail {

namespace {

using Mean = std::optional<TextureMean>;

Mean of(const Spectrum& spectrum) {
  if (const auto* c = std::get_if<ConstantSpectrum>(&spectrum))
    return TextureMean{{c->value, c->value, c->value}};
  const std::array<float, 3>* rgb = nullptr;
  if (const auto* s = std::get_if<SigmoidSpectrum>(&spectrum)) rgb = &s->rgb;
  if (const auto* s = std::get_if<RgbUnboundedSpectrum>(&spectrum)) rgb = &s->rgb;
  return rgb ? Mean(TextureMean{{(*rgb)[0], (*rgb)[1], (*rgb)[2]}}) : std::nullopt;
}

TextureMean of_image(const ImageTexture& texture, bool is_float) {
  const Image image = texture_values(texture, read_stored_image(texture.filename),
                                     is_float ? ImageUse::number : ImageUse::color);
  const auto channels = static_cast<std::size_t>(image.channels);
  std::array<double, 3> sum{}, squares{};
  for (std::size_t i = 0; i < image.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<double>(image.values[i * channels + std::min(c, channels - 1)]);
      if (std::isfinite(v)) sum[c] += v, squares[c] += v * v;
    }
  const auto n = static_cast<double>(std::max<std::size_t>(image.pixels(), 1));
  TextureMean mean{{sum[0] / n, sum[1] / n, sum[2] / n}};
  for (std::size_t c = 0; c < 3; ++c)
    mean.deviation =
        std::max(mean.deviation, std::sqrt(std::max(0.0, squares[c] / n - sum[c] / n * (sum[c] / n))));
  return mean;
}

RGB times(const RGB& a, const RGB& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
double greatest(const RGB& c) { return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)}); }

struct Finder {
  const Scene& scene;
  KnownMeans& known;
  bool is_float;

  Mean operator()(const ImageTexture& t) const { return of_image(t, is_float); }
  Mean operator()(const PtexTexture& t) const {
    const PtexMean mean = mean_of_ptex(t);
    return TextureMean{mean.color, mean.deviation};
  }
  Mean operator()(const CheckerboardTexture& t) const {
    const Mean a = mean_of(scene, known, t.even), b = mean_of(scene, known, t.odd);
    if (!a || !b) return std::nullopt;
    const RGB half{(a->color.r - b->color.r) / 2, (a->color.g - b->color.g) / 2,
                   (a->color.b - b->color.b) / 2};
    return TextureMean{{b->color.r + half.r, b->color.g + half.g, b->color.b + half.b},
                       std::hypot(greatest(half), std::hypot(a->deviation, b->deviation) / std::sqrt(2.0))};
  }
  Mean operator()(const ProductTexture& t) const {
    const Mean a = mean_of(scene, known, t.first), b = mean_of(scene, known, t.second);
    if (!a || !b || (a->deviation > 0 && b->deviation > 0)) return std::nullopt;
    return TextureMean{times(a->color, b->color),
                       a->deviation * greatest(b->color) + b->deviation * greatest(a->color)};
  }
  // What is not worth the search, or not known here.
  Mean operator()(const MixTexture&) const { return std::nullopt; }
  Mean operator()(const DirectionMixTexture&) const { return std::nullopt; }
  Mean operator()(const BilinearTexture&) const { return std::nullopt; }
  Mean operator()(const DotsTexture&) const { return std::nullopt; }
  Mean operator()(const NoiseTexture&) const { return std::nullopt; }
  Mean operator()(const PatternTexture&) const { return std::nullopt; }
  Mean operator()(const MeshAttributeTexture&) const { return std::nullopt; }
  Mean operator()(const UvTexture&) const { return std::nullopt; }
};

}  // namespace

Mean mean_of(const Scene& scene, KnownMeans& known, const SpectrumParameter& parameter) {
  const auto* id = std::get_if<Id<Texture>>(&parameter);
  if (!id) return of(std::get<Spectrum>(parameter));
  if (const auto found = known.find(id->value); found != known.end()) return found->second;
  const Texture& texture = scene.textures.at(id->value);
  const Mean mean =
      std::visit(Finder{scene, known, texture.is_float}, static_cast<const TextureVariant&>(texture.model));
  return known[id->value] = mean;
}

}  // namespace vitrail
