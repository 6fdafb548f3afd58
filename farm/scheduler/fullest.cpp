// SPDX-License-Identifier: Apache-2.0
#include "farm/scheduler/fullest.h"

#include <algorithm>
#include <bit>

namespace vitrail {

Fullest::Fullest(std::size_t domains) : places_(domains), buckets_(65) {}

void Fullest::insert(std::uint32_t domain, std::uint64_t rays) {
  const int bucket = static_cast<int>(std::bit_width(rays));
  std::vector<std::uint32_t>& b = buckets_[static_cast<std::size_t>(bucket)];
  places_[domain] = {bucket, static_cast<std::uint32_t>(b.size()), rays};
  b.push_back(domain);
}

void Fullest::erase(std::uint32_t domain) {
  Place& p = places_[domain];
  std::vector<std::uint32_t>& b = buckets_[static_cast<std::size_t>(p.bucket)];
  places_[b.back()].index = p.index;
  b[p.index] = b.back();
  b.pop_back();
  p = {};
}

void Fullest::set(std::uint32_t domain, std::uint64_t rays) {
  Place& p = places_[domain];
  if (p.bucket == static_cast<int>(std::bit_width(rays))) {
    p.rays = rays;
  } else {
    erase(domain);
    insert(domain, rays);
  }
}

std::optional<std::uint32_t> Fullest::most() const {
  for (std::size_t i = buckets_.size() - 1; i > 0; --i)
    if (const auto& b = buckets_[i]; !b.empty())
      return *std::max_element(
          b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min(b.size(), looked_at)),
          [&](std::uint32_t x, std::uint32_t y) { return places_[x].rays < places_[y].rays; });
  return std::nullopt;
}

std::optional<std::uint32_t> Fullest::fewest() const {
  for (const auto& b : buckets_)
    if (!b.empty())
      return *std::min_element(
          b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min(b.size(), looked_at)),
          [&](std::uint32_t x, std::uint32_t y) { return places_[x].rays < places_[y].rays; });
  return std::nullopt;
}

}  // namespace vitrail
