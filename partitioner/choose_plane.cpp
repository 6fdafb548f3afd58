// SPDX-License-Identifier: Apache-2.0
#include "partitioner/choose_plane.h"

#include <algorithm>
#include <array>
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
  std::size_t items = 0;
  Bounds3f bounds;
};

// Items by where they begin and end on an axis.
class Sweep {
 public:
  Sweep(std::span<const Bounds3f> items, int axis) : axis_(axis) {
    std::vector<std::uint32_t> order(items.size());
    std::iota(order.begin(), order.end(), 0u);
    // What lies in a plane goes below it.
    const auto begin = [&](std::uint32_t i) {
      return std::pair(items[i].lower[axis], items[i].upper[axis] > items[i].lower[axis]);
    };
    std::ranges::sort(order, {}, begin);
    Bounds3f b;
    below_.push_back(b);
    for (const std::uint32_t i : order) {
      lower_.push_back(items[i].lower[axis]);
      is_flat_.push_back(!begin(i).second);
      below_.push_back((extend(b, items[i]), b));
    }
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return items[i].upper[axis]; });
    b = {};
    above_.push_back(b);
    for (std::size_t k = order.size(); k-- > 0;) above_.push_back((extend(b, items[order[k]]), b));
    for (const std::uint32_t i : order) upper_.push_back(items[i].upper[axis]);
  }

  float first() const { return lower_.front(); }
  float last() const { return upper_.back(); }
  float lower(std::size_t i) const { return lower_[i]; }
  float upper(std::size_t i) const { return upper_[i]; }

  Side below(float c) const {
    auto n = static_cast<std::size_t>(std::ranges::lower_bound(lower_, c) - lower_.begin());
    while (n < lower_.size() && lower_[n] == c && is_flat_[n]) ++n;
    Side side{n, below_[n]};
    side.bounds.upper[axis_] = std::min(side.bounds.upper[axis_], c);
    return side;
  }
  Side above(float c) const {
    const auto n = static_cast<std::size_t>(upper_.end() - std::ranges::upper_bound(upper_, c));
    Side side{n, above_[n]};
    side.bounds.lower[axis_] = std::max(side.bounds.lower[axis_], c);
    return side;
  }

 private:
  int axis_;
  std::vector<float> lower_, upper_;     // ascending
  std::vector<bool> is_flat_;            // in the order of lower_
  std::vector<Bounds3f> below_, above_;  // of the first ones in the order of lower_, and the last of upper_
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

std::optional<Cut> choose_plane(std::span<const Bounds3f> all, const Division& division) {
  if (all.empty()) return {};
  std::vector<Bounds3f> items;
  Bounds3f bounds;
  const std::size_t stride = (all.size() + most_counted - 1) / most_counted;
  for (std::size_t i = 0; i < all.size(); i += stride) {
    items.push_back(all[i]);
    extend(bounds, all[i]);
  }
  const auto n = static_cast<double>(items.size()), domains = static_cast<double>(division.domains);
  const double surface = surface_area(bounds);
  std::optional<Cut> best;
  Score best_score;
  for (int axis = 0; axis < 3; ++axis) {
    const Sweep sweep(items, axis);
    for (const float c : candidates_on(sweep, items.size(), division)) {
      const Side below = sweep.below(c), above = sweep.above(c);
      if (below.items == 0 || above.items == 0) continue;
      const auto nb = static_cast<double>(below.items), na = static_cast<double>(above.items);
      const auto k = std::clamp(static_cast<std::uint32_t>(domains * nb / (nb + na) + 0.5), division.least,
                                division.domains - division.least);
      const double kb = k, ka = domains - k;
      Score score{std::max(nb / kb, na / ka) / (n / domains) - 1, 0};
      const auto visits = [&](const Side& side, double d) {
        return surface > 0 ? surface_area(side.bounds) / surface * std::sqrt(d / domains) : 0;
      };
      score.cost = visits(below, kb) + visits(above, ka) + (nb + na - n) / n + score.imbalance / 2;
      if (!better(score, best_score, division.tolerance)) continue;
      best = Cut{{axis, c + 0.0f}, k};
      best_score = score;
    }
  }
  return best;
}

std::optional<Cut> median_plane(std::span<const Bounds3f> items, const Division& division) {
  Bounds3f bounds;
  for (const Bounds3f& b : items) extend(bounds, b);
  const Vector3f e = extent(bounds);
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const float first = std::nextafter(bounds.lower[axis], bounds.upper[axis]);
  const float last = std::nextafter(bounds.upper[axis], bounds.lower[axis]);
  if (items.empty() || first > last) return {};
  std::vector<float> centres;
  for (const Bounds3f& b : items) centres.push_back(std::midpoint(b.lower[axis], b.upper[axis]));
  const std::uint32_t below = division.domains / 2;
  const auto middle =
      centres.begin() + static_cast<std::ptrdiff_t>(centres.size() * below / division.domains);
  std::ranges::nth_element(centres, middle);
  return Cut{{axis, std::clamp(*middle, first, last) + 0.0f}, below};
}

}  // namespace vitrail
