// SPDX-License-Identifier: Apache-2.0
#include "film/group_mix.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "film/working_gamma.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [at, failed] = std::from_chars(text.data(), end, value);
  if (failed != std::errc() || at != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<RGB> factor_in(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ':');) {
    const auto number = number_in(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() == 1) return RGB{numbers[0], numbers[0], numbers[0]};
  if (numbers.size() == 3) return RGB{numbers[0], numbers[1], numbers[2]};
  return std::nullopt;
}

std::vector<RGB> factors_of(const Film& film, std::span<const GroupWeight> weights) {
  const std::vector<std::string>& names = film.key().groups.names;
  std::vector<RGB> factors(names.size(), RGB{1, 1, 1});
  for (const GroupWeight& w : weights) {
    bool is_there = false;
    for (std::size_t g = 0; g < names.size(); ++g)
      if (w.group == "*" || w.group == names[g]) factors[g] = w.factor, is_there = true;
    if (!is_there)
      throw Error(fmt::format(
          "--groups: the film keeps no group \"{}\" apart; it keeps {}", w.group,
          names.empty() ? "none: render with --light-groups" : fmt::format("{}", fmt::join(names, ", "))));
  }
  return factors;
}

}  // namespace

std::vector<GroupWeight> parse_group_weights(const std::string& text) {
  std::vector<GroupWeight> weights;
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ',');) {
    const std::size_t equals = item.find('=');
    const auto factor = equals == item.npos ? std::nullopt : factor_in(item.substr(equals + 1));
    if (!factor)
      throw UsageError(
          "--groups takes NAME=WEIGHT,…, a number or red:green:blue each, as in day=1,lamps=1:.8:.5: " +
          item);
    weights.push_back({item.substr(0, equals), *factor});
  }
  return weights;
}

Image mixed_groups(const Film& film, std::span<const GroupWeight> weights) {
  const std::vector<RGB> factors = factors_of(film, weights);
  Image rgb = black_image(film.width(), film.height(), 3);
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    RGB sum;
    for (std::size_t g = 0; g < factors.size(); ++g) {
      const RGB c = xyz_to_srgb(film.mean_of_group(p, g));
      sum.r += factors[g].r * c.r, sum.g += factors[g].g * c.g, sum.b += factors[g].b * c.b;
    }
    sum = light_of(sum, film.settings().working_gamma);
    float* out = &rgb.values[3 * std::size_t{p}];
    out[0] = static_cast<float>(sum.r), out[1] = static_cast<float>(sum.g),
    out[2] = static_cast<float>(sum.b);
  }
  return rgb;
}

std::vector<PictureChannel> group_channels(const Film& film) {
  std::vector<PictureChannel> channels;
  const std::vector<std::string>& names = film.key().groups.names;
  for (std::size_t g = 0; g < names.size(); ++g) {
    const std::size_t first = channels.size();
    for (const char* part : {"R", "G", "B"})
      channels.push_back(
          {fmt::format("Light.{}.{}", names[g], part), false, std::vector<float>(film.pixels()), {}});
    for (std::uint32_t p = 0; p < film.pixels(); ++p) {
      const RGB c = xyz_to_srgb(film.mean_of_group(p, g));
      channels[first].values[p] = static_cast<float>(c.r);
      channels[first + 1].values[p] = static_cast<float>(c.g);
      channels[first + 2].values[p] = static_cast<float>(c.b);
    }
  }
  return channels;
}

}  // namespace vitrail
