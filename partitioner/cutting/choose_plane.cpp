// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/choose_plane.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vitrail {

namespace {

constexpr std::size_t most_counted = 16384;  // counts and quantiles are known to about 0.4 %
constexpr int quantiles = 512, even_planes = 128;

// What lies on one side of a plane.
struct Side {
  Bounds3f bounds;
  double items = 0, work = 0;

  void add(const Item& i) {
    extend(bounds, i.bounds);
    items += 1;
    work += double{i.work};
  }
  double surface() const { return double{surface_area(bounds)}; }
};

// Numbers in the order of the floats; −0 is 0.
std::uint64_t ordered(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);
  return bits ^ (bits >> 31 ? 0xffffffffu : 0x80000000u);
}

// Items by where they begin and end on an axis.
class Sweep {
 public:
  Sweep(std::span<const Item> items, int axis) : axis_(axis) {
    const auto sort = [&](const auto& key) {
      std::vector<std::uint64_t> order(items.size());
      for (std::uint32_t i = 0; i < items.size(); ++i) order[i] = key(items[i].bounds) | i;
      std::ranges::sort(order);
      return order;
    };
    // What lies in a plane goes below it: of items that begin there it is first.
    for (auto* sides : {&below_, &above_}) sides->reserve(items.size() + 1);
    below_.emplace_back();
    for (const std::uint64_t entry : sort([&](const Bounds3f& b) {
           return ordered(b.lower[axis]) << 32 | std::uint64_t{b.upper[axis] > b.lower[axis]} << 31;
         })) {
      const Item& item = items[entry & 0x7fffffff];
      lower_.push_back(item.bounds.lower[axis]);
      is_flat_.push_back(item.bounds.lower[axis] == item.bounds.upper[axis]);
      below_.emplace_back(below_.back()).add(item);
    }
    above_.emplace_back();
    const auto by_upper = sort([&](const Bounds3f& b) { return ordered(b.upper[axis]) << 32; });
    for (std::size_t k = items.size(); k-- > 0;)
      above_.emplace_back(above_.back()).add(items[by_upper[k] & 0xffffffff]);
    for (const std::uint64_t entry : by_upper) upper_.push_back(items[entry & 0xffffffff].bounds.upper[axis]);
  }

  float first() const { return lower_.front(); }
  float last() const { return upper_.back(); }
  float lower(std::size_t i) const { return lower_[i]; }
  float upper(std::size_t i) const { return upper_[i]; }

  Side below(float c) const {
    auto n = static_cast<std::size_t>(std::ranges::lower_bound(lower_, c) - lower_.begin());
    while (n < lower_.size() && lower_[n] == c && is_flat_[n]) ++n;
    Side side = below_[n];
    side.bounds.upper[axis_] = std::min(side.bounds.upper[axis_], c);
    return side;
  }
  Side above(float c) const {
    Side side = above_[static_cast<std::size_t>(upper_.end() - std::ranges::upper_bound(upper_, c))];
    side.bounds.lower[axis_] = std::max(side.bounds.lower[axis_], c);
    return side;
  }

 private:
  int axis_;
  std::vector<float> lower_, upper_;  // ascending
  std::vector<bool> is_flat_;         // in the order of lower_
  std::vector<Side> below_, above_;   // the first ones in the order of lower_, the last ones of upper_
};

// Ends of items at quantiles, which are dense around the fractions that few domains can share.
std::vector<float> candidates_on(const Sweep& sweep, std::size_t n, const Division& d) {
  std::vector<float> result;
  const auto add = [&](double fraction) {
    const auto at =
        static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(n - 1) + 0.5);
    result.insert(result.end(), {sweep.lower(at), sweep.upper(at)});
  };
  const int steps = quantiles / 2 / static_cast<int>(std::min(d.domains, 1u + quantiles / 2));
  if (steps == 0)
    for (int i = 0; i <= quantiles; ++i) add(static_cast<double>(i) / quantiles);
  else
    for (std::uint32_t k = 1; k < d.domains; ++k)
      for (int i = -steps; i <= steps; ++i) add(k * (1 + d.tolerance * i / steps) / d.domains);
  const double size = double{sweep.last()} - sweep.first();
  for (int k = 1; k <= even_planes; ++k)
    result.push_back(static_cast<float>(sweep.first() + size * k / (even_planes + 1)));
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](float c) { return !(c > sweep.first() && c < sweep.last()); });
  return result;
}

struct Score {
  double imbalance = std::numeric_limits<double>::infinity();
  double cost = std::numeric_limits<double>::infinity();
};

bool better(const Score& a, const Score& b, double tolerance) {
  const bool a_within = a.imbalance <= tolerance, b_within = b.imbalance <= tolerance;
  if (a_within != b_within) return a_within;
  return a_within ? a.cost < b.cost : a.imbalance < b.imbalance;
}

}  // namespace

std::optional<Cut> choose_plane(std::span<const Item> all, const Division& division) {
  if (all.empty()) return {};
  std::vector<Item> items;
  Side whole;
  const std::size_t stride = (all.size() + most_counted - 1) / most_counted;
  for (std::size_t i = 0; i < all.size(); i += stride) {
    items.push_back(all[i]);
    whole.add(all[i]);
  }
  const double domains = division.domains, surface = whole.surface();
  std::optional<Cut> best;
  Score best_score;
  for (int axis = 0; axis < 3; ++axis) {
    const Sweep sweep(items, axis);
    for (const float c : candidates_on(sweep, items.size(), division)) {
      const Side below = sweep.below(c), above = sweep.above(c);
      if (below.items == 0 || above.items == 0) continue;
      const auto share = static_cast<std::uint32_t>(domains * below.work / (below.work + above.work) + 0.5);
      const std::uint32_t k = std::clamp(share, division.least, division.domains - division.least);
      const double k_above = domains - k;
      Score score{std::max(below.work / k, above.work / k_above) / (whole.work / domains) - 1, 0};
      if (surface > 0)
        score.cost =
            (below.surface() * std::sqrt(k / domains) + above.surface() * std::sqrt(k_above / domains)) /
            surface;
      score.cost += (below.items + above.items - whole.items) / whole.items + score.imbalance / 2;
      if (!better(score, best_score, division.tolerance)) continue;
      best = Cut{{axis, c + 0.0f}, k};
      best_score = score;
    }
  }
  return best;
}

std::optional<Cut> median_plane(std::span<const Item> items, const Division& division) {
  Bounds3f bounds;
  for (const Item& i : items) extend(bounds, i.bounds);
  const Vector3f e = extent(bounds);
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const float first = std::nextafter(bounds.lower[axis], bounds.upper[axis]);
  const float last = std::nextafter(bounds.upper[axis], bounds.lower[axis]);
  if (items.empty() || first > last) return {};
  std::vector<float> centres;
  for (const Item& i : items) centres.push_back(std::midpoint(i.bounds.lower[axis], i.bounds.upper[axis]));
  const std::uint32_t below = division.domains / 2;
  const auto middle =
      centres.begin() + static_cast<std::ptrdiff_t>(centres.size() * below / division.domains);
  std::ranges::nth_element(centres, middle);
  return Cut{{axis, std::clamp(*middle, first, last) + 0.0f}, below};
}

}  // namespace vitrail
