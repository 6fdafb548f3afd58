// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/diagnostics.h"

namespace vitrail {

namespace {

constexpr double fixed_one = 4294967296.0;                 // 2³²
constexpr double value_limit = 1 << 30;                    // so that a deposit stays below 2⁶²
constexpr std::int64_t sum_limit = std::int64_t{1} << 62;  // beyond it one more deposit could overflow

constexpr std::size_t plane_count = 2 + luminance_groups;
constexpr std::size_t x_plane = 0, z_plane = 1, y_planes = 2, bin_planes = plane_count;

bool fits(double value) { return std::abs(value) < value_limit; }  // false for NaN

std::int64_t fixed(double v) { return std::llrint(v * fixed_one); }

bool near_overflow(std::int64_t sum) { return sum >= sum_limit || sum <= -sum_limit; }

// A sum that is near overflow takes no more: it stays where `saturated` sees it.
bool add(std::int64_t& sum, std::int64_t value) {
  const std::atomic_ref<std::int64_t> shared(sum);
  if (!near_overflow(shared.fetch_add(value, std::memory_order_relaxed))) return true;
  shared.fetch_sub(value, std::memory_order_relaxed);
  return false;
}

std::int64_t saturating_sum(std::int64_t a, std::int64_t b) {
  std::int64_t sum;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return a > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
}

// Samples 0 … n−1 of a pixel are dealt into the groups in turn.
std::uint64_t samples_of_group(std::uint64_t n, std::size_t group) {
  return n / luminance_groups + (group < n % luminance_groups ? 1 : 0);
}

}  // namespace

Film::Film(const FilmSettings& settings, const FilmKey& key)
    : crop_(settings.crop),
      full_width_(settings.width),
      full_height_(settings.height),
      imaging_ratio_(settings.imaging_ratio),
      bins_(settings.spectrum),
      key_(key) {
  if (crop_.x0 < 0 || crop_.y0 < 0 || crop_.x1 <= crop_.x0 || crop_.y1 <= crop_.y0 ||
      crop_.x1 > full_width_ || crop_.y1 > full_height_)
    throw Error(fmt::format("the crop {}..{} × {}..{} is empty or leaves the image of {}×{} pixels", crop_.x0,
                            crop_.x1, crop_.y0, crop_.y1, full_width_, full_height_));
  const std::size_t pixels = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  if (pixels > std::numeric_limits<std::uint32_t>::max())
    throw Error(
        fmt::format("a film of {}×{} pixels is too large: at most 2³² − 1 pixels", width(), height()));
  if (bins_.count < 0 || bins_.count > max_spectral_bins || !(bins_.min_nm < bins_.max_nm))
    throw Error(fmt::format("a film keeps at most {} spectral bins over an interval of wavelengths",
                            max_spectral_bins));
  sums_.resize((plane_count + static_cast<std::size_t>(bins_.count)) * pixels);
  counts_.resize(pixels);
}

bool Film::deposit(std::uint32_t pixel, std::uint32_t sample, const XYZ& value) {
  if (!fits(value.x) || !fits(value.y) || !fits(value.z)) return false;
  const std::size_t pixels = counts_.size();
  const bool x = add(sums_[x_plane * pixels + pixel], fixed(value.x));
  const bool z = add(sums_[z_plane * pixels + pixel], fixed(value.z));
  const bool y = add(sums_[(y_planes + sample % luminance_groups) * pixels + pixel], fixed(value.y));
  return x && y && z;
}

bool Film::deposit_bin(std::uint32_t pixel, std::size_t bin, double value) {
  return fits(value) && add(sums_[(bin_planes + bin) * counts_.size() + pixel], fixed(value));
}

void Film::count_sample(std::uint32_t pixel) {
  std::atomic_ref(counts_[pixel]).fetch_add(1, std::memory_order_relaxed);
}

void Film::merge(const Film& other) {
  if (crop_ != other.crop_ || full_width_ != other.full_width_ || full_height_ != other.full_height_)
    throw Error("the films differ in size or crop");
  if (key_.scene_hash != other.key_.scene_hash) throw Error("the films are of different scenes");
  if (key_.settings_hash != other.key_.settings_hash || imaging_ratio_ != other.imaging_ratio_ ||
      bins_ != other.bins_)
    throw Error("the films were rendered with different settings");
  const bool same_samples = key_.seed == other.key_.seed;
  const std::size_t pixels = counts_.size();
  for (std::size_t p = 0; p < pixels; ++p) {
    // Another seed's samples are further ones: sample i of it counts as sample n + i.
    const std::size_t shift = same_samples ? 0 : counts_[p] % luminance_groups;
    const auto take = [&](std::size_t to_plane, std::size_t from_plane) {
      std::int64_t& sum = sums_[to_plane * pixels + p];
      sum = saturating_sum(sum, other.sums_[from_plane * pixels + p]);
    };
    take(x_plane, x_plane);
    take(z_plane, z_plane);
    for (std::size_t g = 0; g < luminance_groups; ++g)
      take(y_planes + (g + shift) % luminance_groups, y_planes + g);
    for (std::size_t plane = bin_planes; plane * pixels < sums_.size(); ++plane) take(plane, plane);
    if (__builtin_add_overflow(counts_[p], other.counts_[p], &counts_[p]))
      throw Error("the films hold more than 2³² − 1 samples a pixel together");
  }
}

XYZ Film::mean(std::uint32_t pixel) const {
  const std::size_t pixels = counts_.size();
  if (counts_[pixel] == 0) return {};
  const double weight = imaging_ratio_ / (fixed_one * static_cast<double>(counts_[pixel]));
  std::int64_t y = 0;
  for (std::size_t g = 0; g < luminance_groups; ++g)
    y = saturating_sum(y, sums_[(y_planes + g) * pixels + pixel]);
  return {weight * static_cast<double>(sums_[x_plane * pixels + pixel]), weight * static_cast<double>(y),
          weight * static_cast<double>(sums_[z_plane * pixels + pixel])};
}

double Film::mean_of_bin(std::uint32_t pixel, std::size_t bin) const {
  const std::size_t pixels = counts_.size();
  if (counts_[pixel] == 0) return 0;
  return imaging_ratio_ / (fixed_one * static_cast<double>(counts_[pixel])) *
         static_cast<double>(sums_[(bin_planes + bin) * pixels + pixel]);
}

// With Y_g the sum of the n_g samples of group g, E[Y_g] = n_g μ and Var[Y_g] = n_g σ²; so
// σ² ≈ Σ (Y_g − n_g ȳ)²/n_g / (G − 1) over the G groups that have samples, and the mean ȳ has variance σ²/n.
double Film::variance_of_mean(std::uint32_t pixel) const {
  const std::size_t pixels = counts_.size();
  const std::uint64_t n = counts_[pixel];
  if (n < 2) return 0;
  const double mean_y = mean(pixel).y;
  double scatter = 0;
  int groups = 0;
  for (std::size_t g = 0; g < luminance_groups; ++g) {
    const double n_g = static_cast<double>(samples_of_group(n, g));
    if (n_g == 0) continue;
    const double sum =
        imaging_ratio_ / fixed_one * static_cast<double>(sums_[(y_planes + g) * pixels + pixel]);
    scatter += (sum - n_g * mean_y) * (sum - n_g * mean_y) / n_g;
    ++groups;
  }
  return scatter / (groups - 1) / static_cast<double>(n);
}

std::uint64_t Film::samples(std::uint32_t pixel) const { return counts_[pixel]; }

bool Film::saturated() const { return std::any_of(sums_.begin(), sums_.end(), near_overflow); }

std::uint64_t Film::hash() const {
  const std::array<std::uint64_t, 2> parts{XXH3_64bits(sums_.data(), sums_.size() * sizeof sums_[0]),
                                           XXH3_64bits(counts_.data(), counts_.size() * sizeof counts_[0])};
  return XXH3_64bits(parts.data(), sizeof parts);
}

}  // namespace vitrail
