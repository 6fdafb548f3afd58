// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/texture_mean.h"

namespace vitrail {

namespace {

struct Mean {
  const TextureMeans& means;  // of the textures before it

  MeanSpectrum operator()(const ImageTexture& t) const { return unseen(t.scale, t.invert); }
  MeanSpectrum operator()(const PtexTexture& t) const { return unseen(t.scale, false); }
  MeanSpectrum operator()(const MeshAttributeTexture& t) const { return unseen(t.scale, false); }
  MeanSpectrum operator()(const NoiseTexture& t) const {
    return unseen(t.kind == NoiseTexture::Kind::marble ? 1 : t.scale, false);
  }
  MeanSpectrum operator()(const UvTexture&) const { return unseen(1, false); }
  MeanSpectrum operator()(const CheckerboardTexture& t) const { return between(t.even, t.odd, 0.5); }
  MeanSpectrum operator()(const DotsTexture& t) const {
    constexpr double coverage =
        0.5 * 3.14159265358979 * 0.35 * 0.35;  // radius 0.35 in half of the unit cells
    return between(t.outside, t.inside, coverage);
  }
  MeanSpectrum operator()(const MixTexture& t) const {
    const MeanFloat amount = means.of(t.amount);
    const MeanSpectrum a = means.of(t.first), b = means.of(t.second);
    return {weighted_sum(a.value, 1 - amount.value, b.value, amount.value),
            a.is_exact && b.is_exact && amount.is_exact};
  }
  MeanSpectrum operator()(const DirectionMixTexture& t) const { return between(t.first, t.second, 0.5); }
  MeanSpectrum operator()(const ProductTexture& t) const {
    const MeanSpectrum a = means.of(t.first), b = means.of(t.second);
    return {product(a.value, b.value), a.is_exact && b.is_exact};
  }
  MeanSpectrum operator()(const BilinearTexture& t) const {
    const Spectrum left = between(t.v00, t.v01, 0.5).value, right = between(t.v10, t.v11, 0.5).value;
    return {weighted_sum(left, 0.5, right, 0.5), false};
  }

 private:
  static MeanSpectrum unseen(float scale, bool invert) {
    const float half = 0.5f * scale;
    return {ConstantSpectrum{invert ? 1 - half : half}, false};
  }
  MeanSpectrum between(const SpectrumParameter& first, const SpectrumParameter& second,
                       double weight_of_second) const {
    const MeanSpectrum a = means.of(first), b = means.of(second);
    if (a.value == b.value) return {a.value, a.is_exact && b.is_exact};
    return {weighted_sum(a.value, 1 - weight_of_second, b.value, weight_of_second), false};
  }
};

}  // namespace

TextureMeans::TextureMeans(const std::vector<Texture>& textures) {
  for (const Texture& texture : textures) means_.push_back(std::visit(Mean{*this}, texture.model));
}

MeanSpectrum TextureMeans::of(const SpectrumParameter& parameter) const {
  if (const auto* texture = std::get_if<Id<Texture>>(&parameter)) return means_.at(texture->value);
  return {resolved(std::get<Spectrum>(parameter))};
}

MeanFloat TextureMeans::of(const FloatParameter& parameter) const {
  if (const auto* value = std::get_if<float>(&parameter)) return {static_cast<double>(*value)};
  const MeanSpectrum& mean = means_.at(std::get<Id<Texture>>(parameter).value);
  return {luminance(mean.value), mean.is_exact};
}

}  // namespace vitrail
