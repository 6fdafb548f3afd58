// SPDX-License-Identifier: Apache-2.0
#include "film/film_seeds.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace vitrail {

std::vector<std::uint64_t> seeds_of(const Film& film, const std::string& about) {
  std::vector<std::uint64_t> seeds;
  const nlohmann::json json = nlohmann::json::parse(about, nullptr, false);
  if (const auto found = json.find("seeds"); json.is_object() && found != json.end() && found->is_array())
    for (const nlohmann::json& seed : *found)
      if (seed.is_number_unsigned()) seeds.push_back(seed.get<std::uint64_t>());
  if (seeds.empty()) return {film.key().seed};
  std::ranges::sort(seeds);
  return seeds;
}

std::string with_seeds(const std::string& about, std::span<const std::uint64_t> seeds) {
  nlohmann::json json = nlohmann::json::parse(about, nullptr, false);
  if (!json.is_object()) json = nlohmann::json::object();
  json["seeds"] = std::vector<std::uint64_t>(seeds.begin(), seeds.end());
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::uint64_t merged_seed(std::span<const std::uint64_t> seeds) {
  if (seeds.size() == 1) return seeds.front();
  std::uint64_t hash = 0;
  for (const std::uint64_t seed : seeds) {
    hash = (hash ^ seed) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash | std::uint64_t{1} << 63;
}

}  // namespace vitrail
