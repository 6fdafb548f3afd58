// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "film/array_checksum.h"
#include "film/film_planes.h"
#include "film/picture_fields.h"
#include "film/pixel_sums.h"
#include "scene/records/film_extent.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// The bits by which the parts of a deposit are rounded.
template <class... Numbers>
std::uint64_t dice(std::uint32_t pixel, std::uint32_t sample, Numbers... values) {
  const std::array<std::uint64_t, 1 + sizeof...(values)> of{static_cast<std::uint64_t>(pixel) << 32 | sample,
                                                            std::bit_cast<std::uint64_t>(values)...};
  return XXH3_64bits(of.data(), sizeof of);
}

// One of the two whole numbers about v, by 21 of the bits: v on the average.
WideSum rounded(double v, std::uint64_t bits) {
  const double below = std::floor(v);
  const bool up = static_cast<double>(bits & 0x1fffff) * 0x1p-21 < v - below;
  return wide_sum_of(below + static_cast<double>(up));  // no branch: nobody can guess it
}

// A deposit in whole quanta. `place`: of its pixel in the whole picture.
struct Quanta {
  WideSum x, y, z;
};
Quanta quanta_of(const XYZ& value, int exponent, std::uint32_t place, std::uint32_t sample) {
  const std::uint64_t bits = dice(place, sample, value.x, value.y, value.z);
  const double quanta = power_of_two(-exponent);
  return {rounded(quanta * value.x, bits), rounded(quanta * value.y, bits >> 42),
          rounded(quanta * value.z, bits >> 21)};
}

// Of the parts of a deposit.
struct Size {
  double sum, largest;
};
Size size_of(const XYZ& value) {
  const double x = std::abs(value.x), y = std::abs(value.y), z = std::abs(value.z);
  return {x + y + z, std::max({x, y, z})};
}
bool accept(const Size& size, const FilmKey& key, int exponent, Refused& refused) {
  if (size.largest < power_of_two(exponent + deposit_bits(key.splats)) && std::isfinite(size.sum))
    return true;
  std::uint64_t& count = std::isfinite(size.sum) ? refused.too_large : refused.nonfinite;
  std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  return false;
}

// The seeds of films that are to be merged follow on each other as a rule: so the first samples of each,
// which may be the only ones, are in different groups.
std::size_t group_in(const FilmKey& key, std::uint32_t sample) {
  return static_cast<std::size_t>((group_of(sample) + key.seed) % sample_groups);
}

// Of a pixel in the whole picture: a crop rounds as the whole does.
std::uint32_t place_in(const FilmSettings& settings, std::uint32_t pixel) {
  const PixelRect& crop = settings.crop;
  const auto width = static_cast<std::uint32_t>(crop.x1 - crop.x0);
  return (static_cast<std::uint32_t>(crop.y0) + pixel / width) * static_cast<std::uint32_t>(settings.width) +
         static_cast<std::uint32_t>(crop.x0) + pixel % width;
}

}  // namespace

namespace {

// Of the crop. Throws Error where there cannot be such a film.
std::uint64_t pixels_of(const FilmSettings& s) {
  const PixelRect& c = s.crop;
  if (c.x0 < 0 || c.y0 < 0 || c.x1 <= c.x0 || c.y1 <= c.y0 || c.x1 > s.width || c.y1 > s.height)
    throw Error(fmt::format("the crop {}..{} × {}..{} is empty or leaves the image of {}×{} pixels", c.x0,
                            c.x1, c.y0, c.y1, s.width, s.height));
  if (s.width > max_film_extent || s.height > max_film_extent)
    throw Error(fmt::format("a picture of {}×{} pixels is too large: at most {} a side", s.width, s.height,
                            max_film_extent));
  const int width = c.x1 - c.x0, height = c.y1 - c.y0;
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("a film of {}×{} pixels is too large: at most 2³² − 1 pixels", width, height));
  return pixels;
}

}  // namespace

std::uint64_t film_bytes(const FilmSettings& settings, const FilmKey& key) {
  const std::uint64_t planes = plane_count + static_cast<std::uint64_t>(settings.spectrum.count) +
                               sum_planes(settings.layers) + planes_a_group * key.groups.names.size() +
                               (key.splats ? sample_groups : 0);
  return pixels_of(settings) * (planes * sizeof(WideSum) + sample_groups * sizeof(std::uint32_t) +
                                id_planes(settings.layers) * sizeof(std::int64_t) +
                                matte_planes(settings.layers) * sizeof(MattePixel));
}

Film::Film(std::shared_ptr<FilmScratch> scratch)
    : scratch_(std::move(scratch)), sums_(scratch_), counts_(scratch_), ids_(scratch_), mattes_(scratch_) {}

Film::Film(const FilmSettings& settings, const FilmKey& key, int exponent, int length_exponent,
           std::shared_ptr<FilmScratch> scratch)
    : Film(std::move(scratch)) {
  settings_ = settings, key_ = key, exponent_ = exponent, length_exponent_ = length_exponent;
  const std::size_t size = pixels_of(settings);
  if (settings_.spectrum.count < 0 || settings_.spectrum.count > max_spectral_bins ||
      !(settings_.spectrum.min_nm < settings_.spectrum.max_nm))
    throw Error(fmt::format("a film keeps at most {} spectral bins over an interval of wavelengths",
                            max_spectral_bins));
  sums_.resize((first_weights() + (key_.splats ? sample_groups : 0)) * size + single_sums(key_));
  counts_.resize(sample_groups * size);
  ids_.resize(id_planes(settings_.layers) * size);
  mattes_.resize(matte_planes(settings_.layers) * size);
}

void Film::written_in_scratch(const void* at, std::size_t bytes) { scratch_->writes(at, bytes); }

// One of those beside the planes.
void Film::add_single(std::size_t sum, const WideSum& quanta) {
  add_shared(sums_[sum], quanta);
  written(sums_[sum]);
}

std::size_t Film::group(std::uint32_t sample) const { return group_in(key_, sample); }

// `size` of the parts of a deposit together, `largest` of them.
bool Film::accepts(double size, double largest) { return accept({size, largest}, key_, exponent_, refused_); }

std::uint32_t Film::place(std::uint32_t pixel) const { return place_in(settings_, pixel); }

// The same sums however deposits are put together: their quanta are whole before weights multiply them.
void Film::add(std::size_t plane, std::uint32_t pixel, const WideSum& quanta, const Footprint* spread) {
  assert((spread != nullptr) == key_.splats);
  WideSum* const sums = sums_.data() + plane * pixels();
  if (!spread) return add_shared(sums[pixel], quanta), written(sums[pixel]);
  const Int128 value = value_of(quanta);
  for_each_pixel(*spread, pixel, width(), height(), [&](std::size_t at, std::int32_t weight) {
    add_shared(sums[at], wide_sum(value * weight));
    written(sums[at]);
  });
}

bool Film::deposit(std::uint32_t pixel, std::uint32_t sample, const XYZ& value, const Footprint* spread,
                   std::span<const GroupLight> parts) {
  assert(parts.empty() != key_.groups.any());
  if (!accept(size_of(value), key_, exponent_, refused_)) return false;
  const auto [in_x, light, in_z] = quanta_of(value, exponent_, place(pixel), sample);
  add(x_plane, pixel, in_x, spread);
  add(z_plane, pixel, in_z, spread);
  add(y_planes + group(sample), pixel, light, spread);
  if (!parts.empty()) [[unlikely]]
    add_to_groups(pixel, sample, {in_x, light, in_z}, parts, spread);
  if (key_.photons.photons > 0) add_single(first_batch() + batch_of(sample), light);
  return true;
}

// `quanta`: X, Y, Z of the whole deposit.
void Film::add_to_groups(std::uint32_t pixel, std::uint32_t sample, std::array<WideSum, 3> quanta,
                         std::span<const GroupLight> parts, const Footprint* spread) {
  const double a_quantum = power_of_two(-exponent_);
  for (const GroupLight& part : parts.first(parts.size() - 1)) {
    const std::array<double, 3> values{part.value.x, part.value.y, part.value.z};
    const std::uint64_t bits = dice(place(pixel), sample, values[0], values[1], values[2]);
    for (std::size_t c = 0; c < planes_a_group; ++c) {
      const WideSum share = rounded(a_quantum * values[c], bits >> 21 * c);
      add(first_group() + planes_a_group * part.group + c, pixel, share, spread);
      quanta[c] = wide_sum(value_of(quanta[c]) - value_of(share));
    }
  }
  for (std::size_t c = 0; c < planes_a_group; ++c)
    add(first_group() + planes_a_group * parts.back().group + c, pixel, quanta[c], spread);
}

double Film::clamp(std::uint32_t pixel, std::uint32_t sample, const XYZ& value) {
  if (!(key_.clamp > 0)) return 1;
  const double largest =
      settings_.imaging_ratio * std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
  if (!(largest > key_.clamp) || !std::isfinite(largest)) return 1;
  const double left = key_.clamp / largest, taken = (1 - left) * value.y;
  if (accepts(taken, std::abs(taken)))
    add_single(sums_.size() - 1, rounded(power_of_two((key_.splats ? weight_bits : 0) - exponent_) * taken,
                                         dice(place(pixel), sample, taken)));
  return left;
}

bool Film::deposit_bin(std::uint32_t pixel, std::uint32_t sample, std::size_t bin, double value,
                       const Footprint* spread) {
  if (!accepts(value, std::abs(value))) return false;
  const double quanta = power_of_two(-exponent_);
  add(bin_planes + bin, pixel, rounded(quanta * value, dice(place(pixel), sample, value)), spread);
  return true;
}

std::size_t Film::first_plane(Layer layer) const {
  return bin_planes + static_cast<std::size_t>(settings_.spectrum.count) +
         sum_planes(settings_.layers, static_cast<std::size_t>(layer));
}

std::size_t Film::first_group() const {
  return bin_planes + static_cast<std::size_t>(settings_.spectrum.count) + sum_planes(settings_.layers);
}

std::size_t Film::first_weights() const { return first_group() + planes_a_group * key_.groups.names.size(); }

int Film::exponent_of(Layer layer) const {
  return kind_of(layer).is_length ? length_exponent_ : default_exponent;
}

std::size_t Film::place_of_id(std::uint32_t pixel, Layer layer) const {
  return id_planes(settings_.layers, static_cast<std::size_t>(layer)) * pixels() + pixel;
}

void Film::deposit_layer(std::uint32_t pixel, std::uint32_t sample, Layer layer,
                         std::span<const double> values, const Footprint* spread) {
  const int exponent = exponent_of(layer);
  const double limit = power_of_two(exponent + deposit_bits(key_.splats));
  if (!std::ranges::all_of(values, [&](double v) { return std::abs(v) < limit; })) {
    std::atomic_ref(refused_.nonfinite).fetch_add(1, std::memory_order_relaxed);
    return;
  }
  const std::size_t first = first_plane(layer);
  for (std::size_t i = 0; i < values.size(); ++i)
    add(first + i, pixel, rounded(power_of_two(-exponent) * values[i], dice(place(pixel), sample, values[i])),
        spread);
}

// The greater, the earlier the sample; of one sample, the lesser the id.
void Film::put_id(std::uint32_t pixel, std::uint32_t sample, Layer layer, std::uint32_t id) {
  const std::int64_t code = static_cast<std::int64_t>(0x7fffffffu - sample) << 32 | (0xffffffffu - id);
  reading(ids_[place_of_id(pixel, layer)]);
  std::atomic_ref held(ids_[place_of_id(pixel, layer)]);
  std::int64_t before = held.load(std::memory_order_relaxed);
  while (before < code && !held.compare_exchange_weak(before, code, std::memory_order_relaxed)) {
  }
}

std::uint32_t Film::id(std::uint32_t pixel, Layer layer) const {
  const std::int64_t code = reading(ids_[place_of_id(pixel, layer)]);
  return code == 0 ? 0 : 0u - static_cast<std::uint32_t>(code);
}

double Film::mean_of_layer(std::uint32_t pixel, Layer layer, std::size_t plane) const {
  const double n = weight(pixel);
  if (!(n > 0)) return 0;
  const WideSum& sum = reading(sums_[(first_plane(layer) + plane) * pixels() + pixel]);
  return power_of_two(exponent_of(layer)) * static_cast<double>(value_of(sum)) / n;
}

void Film::count_sample(std::uint32_t pixel, std::uint32_t sample, const Footprint* spread) {
  std::uint32_t& count = counts_[group(sample) * pixels() + pixel];
  std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  if (key_.splats) add(first_weights() + group(sample), pixel, wide_sum_of(1), spread);
  if (key_.photons.photons > 0) add_single(first_batch() + photon_batches + batch_of(sample), wide_sum_of(1));
  written(count);
}

bool PixelSums::is_plain(const Film& film) {
  const FilmKey& key = film.key();
  return !key.splats && !key.groups.any() && key.photons.photons == 0;
}

bool PixelSums::deposit(std::uint32_t pixel, std::uint32_t sample, const XYZ& value) {
  if (!accept(size_of(value), film_.key(), film_.exponent(), film_.refused())) return false;
  turn_to(pixel);
  const auto [x, y, z] = quanta_of(value, film_.exponent(), place_, sample);
  x_ += x;
  y_[group_in(film_.key(), sample)] += y;
  z_ += z;
  return true;
}

void PixelSums::count_sample(std::uint32_t pixel, std::uint32_t sample) {
  turn_to(pixel);
  ++counts_[group_in(film_.key(), sample)];
}

void PixelSums::turn_to(std::uint32_t pixel) {
  if (holds_any_ && pixel == pixel_) return;
  give();
  pixel_ = pixel;
  place_ = place_in(film_.settings(), pixel);
  holds_any_ = true;
}

void PixelSums::give() {
  if (!holds_any_) return;
  FilmScratch* const scratch = film_.scratch().get();
  const std::size_t pixels = film_.pixels();
  const auto add = [&](std::size_t plane, WideSum& quanta) {
    if (quanta == WideSum{}) return;
    WideSum& sum = film_.sums()[plane * pixels + pixel_];
    if (scratch) scratch->writes(&sum, sizeof sum);
    add_shared(sum, std::exchange(quanta, {}));
  };
  add(x_plane, x_);
  add(z_plane, z_);
  for (std::size_t g = 0; g < sample_groups; ++g) {
    add(y_planes + g, y_[g]);
    if (counts_[g] == 0) continue;
    std::uint32_t& count = film_.counts()[g * pixels + pixel_];
    if (scratch) scratch->writes(&count, sizeof count);
    std::atomic_ref(count).fetch_add(std::exchange(counts_[g], 0), std::memory_order_relaxed);
  }
  holds_any_ = false;
}

float rounded_threshold(double threshold) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(threshold));
  return std::bit_cast<float>(bits & 0xffff0000);
}

std::string difference(const Film& a, const Film& b) {
  const auto what = [](const Film& f) {
    return SumsOf{f.key(), f.settings(), f.exponent(), f.length_exponent()};
  };
  return difference(what(a), what(b));
}

void Film::merge(const Film& other) {
  const std::string what = difference(*this, other);
  if (!what.empty()) throw Error(what);
  for (std::uint32_t p = 0; p < pixels(); ++p)
    if (samples(p) + other.samples(p) > std::numeric_limits<std::uint32_t>::max())
      throw Error("the films hold more than 2³² − 1 samples a pixel together");
  for (std::size_t i = 0; i < sums_.size(); ++i) writing(sums_[i]) += other.reading(other.sums_[i]);
  for (std::size_t i = 0; i < counts_.size(); ++i) writing(counts_[i]) += other.reading(other.counts_[i]);
  for (std::size_t i = 0; i < ids_.size(); ++i)
    writing(ids_[i]) = std::max(ids_[i], other.reading(other.ids_[i]));
  for (std::size_t i = 0; i < mattes_.size(); ++i) writing(mattes_[i]) += other.reading(other.mattes_[i]);
  refused_.nonfinite += other.refused_.nonfinite;
  refused_.too_large += other.refused_.too_large;
}

std::uint64_t Film::hash() const {
  const auto of = [&](const auto& array) { return checksum_of(std::span(array), scratch_.get()); };
  return hash_of_arrays({of(sums_), of(counts_), of(ids_), of(mattes_)}, !ids_.empty(), !mattes_.empty());
}

}  // namespace vitrail
