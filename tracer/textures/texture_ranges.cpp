// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/texture_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tracer/sampling/luminance_of.h"
#include "tracer/textures/baked_image.h"
#include "tracer/textures/noise.h"

namespace vitrail {

namespace {

Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
Interval operator*(Interval a, double k) {
  return k < 0 ? Interval{a.high * k, a.low * k} : Interval{a.low * k, a.high * k};
}

ValueRange constant(double value) { return {value, value, value}; }

// Of sums: what one has at one wavelength makes up for nothing at another.
ValueRange operator+(const ValueRange& a, const ValueRange& b) {
  return {std::min(a.least, 0.0) + std::min(b.least, 0.0), a.mean + b.mean,
          std::max(a.most, 0.0) + std::max(b.most, 0.0)};
}
ValueRange operator*(const ValueRange& a, const ValueRange& b) {
  const auto times = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
  const std::array<double, 4> all{times(a.least, b.least), times(a.least, b.most), times(a.most, b.least),
                                  times(a.most, b.most)};
  return {std::ranges::min(all), times(a.mean, b.mean), std::ranges::max(all)};
}
ValueRange one_of(const ValueRange& a, const ValueRange& b, double share_of_b) {
  return {std::min(a.least, b.least), a.mean * (1 - share_of_b) + b.mean * share_of_b,
          std::max(a.most, b.most)};
}
ValueRange one_less(const ValueRange& a) { return {1 - a.most, 1 - a.mean, 1 - a.least}; }
ValueRange mixed(const ValueRange& first, const ValueRange& second, const ValueRange& amount) {
  if (amount.least == amount.most && (amount.most == 0 || amount.most == 1))
    return amount.most == 0 ? first : second;
  return one_less(amount) * first + amount * second;
}
ValueRange of(Interval i) { return {i.low, (i.low + i.high) / 2, i.high}; }

// Of a + b·x + c·y + d·z in a box.
Interval linear(const Bounds3d& box, double offset, Vector3d by) {
  Interval sum{offset, offset};
  for (int axis = 0; axis < 3; ++axis) sum = sum + Interval{box.lower[axis], box.upper[axis]} * by[axis];
  return sum;
}
// Along a vector of texture space, after the inverse of the transform.
Interval along(const Bounds3d& box, const Transform& texture_to_world, Vector3d v, double offset) {
  const Transform inverted = inverse(texture_to_world);
  const auto& m = inverted.m;
  const auto column = [&](std::size_t j) { return m[0][j] * v.x + m[1][j] * v.y + m[2][j] * v.z; };
  return linear(box, offset + column(3), {column(0), column(1), column(2)});
}

std::size_t slot_of(const std::string& name) { return static_cast<std::size_t>(std::stoul(name)); }

// Of what the corners of a triangle have.
Interval of_corners(const TexturePoint& at, const std::string& slot, std::size_t channel) {
  const std::size_t index = slot_of(slot);
  if (index >= at.attributes.size()) return {};
  const auto& corners = at.attributes[index].corners;
  const auto [low, high] = std::minmax({corners[0][channel], corners[1][channel], corners[2][channel]});
  return {static_cast<double>(low), static_cast<double>(high)};
}

struct MappedBox {
  Interval s, t;
};
MappedBox mapped(const TextureMapping& mapping, const TextureRegion& region) {
  const auto of_uv = [&](float a, float b, float c) {
    const auto k = static_cast<double>(c);
    return region.u * static_cast<double>(a) + region.v * static_cast<double>(b) + Interval{k, k};
  };
  if (const auto* m = std::get_if<UvMapping>(&mapping))
    return {of_uv(m->a, m->b, m->c), of_uv(m->d, m->e, m->f)};
  if (const auto* m = std::get_if<PlanarMapping>(&mapping))
    return {along(region.p, m->texture_to_world, m->v1, m->offset_s),
            along(region.p, m->texture_to_world, m->v2, m->offset_t)};
  if (const auto* m = std::get_if<CylindricalMapping>(&mapping))
    return {{0, 1}, m->of_direction ? Interval{-1, 1} : along(region.p, m->texture_to_world, {0, 0, 1}, 0)};
  if (const auto* m = std::get_if<AttributeMapping>(&mapping))
    return {of_corners(region.middle, m->slot, 0), of_corners(region.middle, m->slot, 1)};
  return {{0, 1}, {0, 1}};
}

// How much of an interval is in even cells of size 1.
double even_share(Interval i) {
  const auto even_below = [](double x) {
    const double pairs = std::floor(x / 2);
    return pairs + std::min(x - 2 * pairs, 1.0);
  };
  const double width = i.high - i.low;
  if (!(width > 1e-9)) return std::floor(i.low) == 2 * std::floor(i.low / 2) ? 1 : 0;
  return std::clamp((even_below(i.high) - even_below(i.low)) / width, 0.0, 1.0);
}

bool is_one_cell(Interval i) {
  const double rounding = 1e-6 * (1 + std::abs(i.low) + std::abs(i.high));
  return std::floor(i.low - rounding) == std::floor(i.high + rounding);
}

double most_of(const NoiseTexture& t) {
  if (t.kind == NoiseTexture::Kind::windy) return (1 + 0.5 + 0.25) * 2;
  const double omega = std::abs(static_cast<double>(t.roughness));
  double sum = 0, weight = 1;
  for (int i = 0; i < t.octaves; ++i, weight *= omega) sum += weight;
  return sum + 0.2 * weight;
}

}  // namespace

void TextureRegion::extend(Point2d uv, Point3d at) {
  const auto grow = [](Interval& i, double x) {
    i = i.low > i.high ? Interval{x, x} : Interval{std::min(i.low, x), std::max(i.high, x)};
  };
  grow(u, uv.x);
  grow(v, uv.y);
  vitrail::extend(p, at);
}

struct TextureRanges::Rules {
  TextureRanges& ranges;
  const TextureRegion& region;
  std::uint32_t id;

  ValueRange in(const SpectrumParameter& parameter) const {
    if (const auto* texture = std::get_if<Id<Texture>>(&parameter))
      return ranges.of_texture(texture->value, region);
    return constant(ranges.luminance_of(std::get<Spectrum>(parameter)));
  }
  ValueRange in(const FloatParameter& parameter) const {
    if (const auto* texture = std::get_if<Id<Texture>>(&parameter))
      return ranges.of_texture(texture->value, region);
    return constant(static_cast<double>(std::get<float>(parameter)));
  }
  double in_the_middle() const {
    const Id<Texture> texture{id};
    if (ranges.records_[id].is_float) return ranges.textures_->number(FloatParameter{texture}, region.middle);
    return vitrail::luminance_of(
        [&](const SampledWavelengths& w) {
          return ranges.textures_->spectrum(SpectrumParameter{texture}, region.middle, w);
        },
        2);
  }

  ValueRange operator()(const ImageTexture& t) const {
    const MappedBox at = mapped(t.mapping, region);
    return ranges.sums_of(id).over(at.s, at.t, t.wrap, t.filter != TextureFilter::nearest);
  }
  ValueRange operator()(const CheckerboardTexture& t) const {
    std::array<Interval, 3> at;
    at[2] = {0.5, 0.5};
    if (t.solid)
      at = {along(region.p, t.texture_to_world, {1, 0, 0}, 0),
            along(region.p, t.texture_to_world, {0, 1, 0}, 0),
            along(region.p, t.texture_to_world, {0, 0, 1}, 0)};
    else
      at[0] = mapped(t.mapping, region).s, at[1] = mapped(t.mapping, region).t;
    double odd = 1;
    for (const Interval& i : at) odd *= 2 * even_share(i) - 1;
    odd = (1 - odd) / 2;
    if (std::ranges::all_of(at, is_one_cell)) return in(odd > 0.5 ? t.odd : t.even);
    return one_of(in(t.even), in(t.odd), odd);
  }
  ValueRange operator()(const ProductTexture& t) const { return in(t.first) * in(t.second); }
  ValueRange operator()(const MixTexture& t) const { return mixed(in(t.first), in(t.second), in(t.amount)); }
  ValueRange operator()(const DirectionMixTexture& t) const {
    const double amount = std::abs(dot(region.middle.normal, t.direction));
    return mixed(in(t.second), in(t.first), {0, amount, std::max(1.0, length(t.direction))});
  }
  ValueRange operator()(const BilinearTexture& t) const {
    const MappedBox at = mapped(t.mapping, region);
    const ValueRange s = of(at.s), v = of(at.t);
    return one_less(s) * one_less(v) * in(t.v00) + one_less(s) * v * in(t.v01) + s * one_less(v) * in(t.v10) +
           s * v * in(t.v11);
  }
  ValueRange operator()(const DotsTexture& t) const {
    const MappedBox at = mapped(t.mapping, region);
    const bool inside = inside_dot((at.s.low + at.s.high) / 2, (at.t.low + at.t.high) / 2);
    return one_of(in(t.outside), in(t.inside), inside ? 1 : 0);
  }
  ValueRange operator()(const NoiseTexture& t) const {
    if (t.kind == NoiseTexture::Kind::marble) return {0, in_the_middle(), 1};
    const double most = most_of(t);
    return {-most, in_the_middle(), most};
  }
  // What is anywhere in the map may be here.
  ValueRange operator()(const PatternTexture& t) const {
    if (t.map.empty()) return {0, in_the_middle(), 1};
    ValueRange range = in(t.map.front().value);
    for (const PatternStop& stop : t.map) range = one_of(range, in(stop.value), 0.5);
    range.mean = in_the_middle();
    return range;
  }
  ValueRange operator()(const MeshAttributeTexture& t) const {
    const auto scale = static_cast<double>(t.scale);
    if (!ranges.records_[id].is_float) return {0, in_the_middle(), std::max(scale, 0.0)};
    const Interval corners = of_corners(region.middle, t.name, 0) * scale;
    return {corners.low, in_the_middle(), corners.high};
  }
  // Not in bundles.
  ValueRange operator()(const PtexTexture&) const { return {}; }
  ValueRange operator()(const UvTexture&) const { return {}; }
};

ValueRange TextureRanges::luminances(const SpectrumParameter& parameter, const TextureRegion& region) {
  if (const auto* spectrum = std::get_if<Spectrum>(&parameter)) return constant(luminance_of(*spectrum));
  if (!textures_) return {};
  ++region_;
  ValueRange range = of_texture(std::get<Id<Texture>>(parameter).value, region);
  range = {std::max(range.least, 0.0), std::max(range.mean, 0.0), std::max(range.most, 0.0)};
  return range;
}

ValueRange TextureRanges::numbers(const FloatParameter& parameter, const TextureRegion& region) {
  if (const auto* number = std::get_if<float>(&parameter)) return constant(static_cast<double>(*number));
  if (!textures_) return constant(1);
  ++region_;
  return of_texture(std::get<Id<Texture>>(parameter).value, region);
}

ValueRange TextureRanges::of_texture(std::uint32_t id, const TextureRegion& region) {
  known_.resize(records_.size());
  if (known_[id].region == region_) return known_[id].range;
  const ValueRange range = std::visit(Rules{*this, region, id}, records_[id].model);
  known_[id] = {region_, range};
  return range;
}

double TextureRanges::luminance_of(const Spectrum& constant) {
  const auto [known, is_new] = luminance_.try_emplace(&constant, 0);
  if (is_new) known->second = luminance(constant);
  return known->second;
}

const ImageSums& TextureRanges::sums_of(std::uint32_t id) {
  // 3 MiB each, and 170 KiB of many.
  constexpr std::size_t few = 16;
  constexpr int fine = 512, coarse = 128;
  const BakedImage& image = textures_->image(Id<Texture>{id});
  std::unique_ptr<ImageSums>& sums = sums_[&image];
  if (!sums) sums = std::make_unique<ImageSums>(image, sums_.size() > few ? coarse : fine);
  return *sums;
}

}  // namespace vitrail
