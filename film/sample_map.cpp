// SPDX-License-Identifier: Apache-2.0
#include "film/sample_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "film/film_noise.h"

namespace vitrail {

namespace {

// Pixels to either side of a pixel that speak for it. The greatest is left out: bright specks are rare, and
// would draw samples to where nothing more is found. Two of them tell of something that few samples hit.
constexpr int reach = 3;
// Of what a pixel says: that of a pixel of which one sample in so many hits something.
constexpr double greatest_variance = 64;
constexpr double least_share = 1.0 / 4, greatest_share = 16;  // of the mean of all samples
constexpr double most_of_a_pixel = 0x1p22;  // the numbers of samples that rays carry end above

// Relative variance of a sample of each pixel: an estimate of one degree of freedom.
std::vector<float> relative_variances(const Film& film) {
  std::vector<float> values(film.pixels());
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    const double y = film.mean(p).y;
    const double relative =
        film.variance_of_mean(p) * static_cast<double>(film.samples(p)) / (y * y + relative_error_floor);
    values[p] = static_cast<float>(std::min(relative, greatest_variance));
  }
  return values;
}

// √ of the mean over the pixels around (x, y), without it and without the greatest.
float deviation_around(const std::vector<float>& variances, int width, int height, int x, int y) {
  double sum = 0;
  float greatest = 0;
  int count = 0;
  for (int j = std::max(y - reach, 0); j <= std::min(y + reach, height - 1); ++j)
    for (int i = std::max(x - reach, 0); i <= std::min(x + reach, width - 1); ++i) {
      if (i == x && j == y) continue;
      const float v = variances[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(i)];
      sum += static_cast<double>(v);
      greatest = std::max(greatest, v);
      ++count;
    }
  if (count < 2) return 0;
  return static_cast<float>(std::sqrt(std::max(0.0, sum - static_cast<double>(greatest)) / (count - 1)));
}

// In [0, 1), by pixel and samples so far: rounding by it makes the mean of what is rounded exact.
double dither(std::uint32_t pixel, std::uint64_t samples) {
  std::uint64_t bits = (pixel + (samples << 32)) * 0x9e3779b97f4a7c15u;
  bits = (bits ^ bits >> 31) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(bits >> 40) * 0x1p-24;
}

// One of the two round numbers about `samples`, which is 2 or more, by `die` in [0, 1): `samples` on the
// average. Round are 2ᵏ and 3·2ᵏ that are even: other numbers of an Owen-scrambled sequence are worth less.
std::uint32_t round_number(double samples, double die) {
  std::uint32_t below = std::bit_floor(static_cast<std::uint32_t>(samples)), above = 2 * below;
  if (const std::uint32_t between = below / 2 * 3; between % 2 == 0)
    (between <= samples ? below : above) = between;
  return (samples - below) / (above - below) > die ? above : below;
}

// Of a sample of each pixel, by what is around it.
std::vector<float> deviations(const Film& film) {
  const std::vector<float> variances = relative_variances(film);
  std::vector<float> values;
  values.reserve(variances.size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      values.push_back(deviation_around(variances, film.width(), film.height(), x, y));
  // Where nothing scatters, all pixels alike.
  if (std::ranges::all_of(values, [](float d) { return d == 0; })) std::ranges::fill(values, 1.0f);
  return values;
}

std::vector<float> samples_held(const Film& film) {
  std::vector<float> values(film.pixels());
  for (std::uint32_t p = 0; p < film.pixels(); ++p) values[p] = static_cast<float>(film.samples(p));
  return values;
}

}  // namespace

bool is_even(const Film& film) {
  for (std::uint32_t p = 1; p < film.pixels(); ++p)
    if (film.samples(p) != film.samples(0)) return false;
  return true;
}

std::vector<std::uint32_t> more_samples(const Film& film, std::uint64_t samples) {
  const std::uint32_t pixels = film.pixels();
  const double mean = static_cast<double>(film.samples() + samples) / pixels;
  const double least = std::max(2.0, mean * least_share),
               greatest = std::clamp(mean * greatest_share, 2.0, most_of_a_pixel);
  const std::vector<float> share = is_even(film) ? deviations(film) : samples_held(film);
  const auto more = [&](std::uint32_t p, double scale) {
    const double wanted = std::clamp(scale * static_cast<double>(share[p]), least, greatest);
    const auto held = static_cast<std::uint32_t>(film.samples(p));
    return std::max(round_number(wanted, dither(p, held)), held) - held;
  };
  const auto sum = [&](double scale) {
    std::uint64_t all = 0;
    for (std::uint32_t p = 0; p < pixels; ++p) all += more(p, scale);
    return all;
  };
  // The greatest scale that keeps within `samples`: all numbers grow with it.
  double enough = 0, too_much = 1;
  constexpr double beyond = 0x1p60;
  while (too_much < beyond && sum(too_much) <= samples) enough = too_much, too_much *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = (enough + too_much) / 2;
    (sum(middle) <= samples ? enough : too_much) = middle;
  }
  std::vector<std::uint32_t> map(pixels);
  for (std::uint32_t p = 0; p < pixels; ++p) map[p] = more(p, enough);
  return map;
}

}  // namespace vitrail
