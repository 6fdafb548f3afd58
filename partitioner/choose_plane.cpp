// SPDX-License-Identifier: Apache-2.0
#include "partitioner/choose_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace vitrail {

namespace {

constexpr std::size_t most_counted = 16384;  // counts and quantiles are known to about 0.4 %
constexpr int quantile_steps = 8;            // on each side of the balanced split
constexpr int even_planes = 16;

// Where items begin and end on an axis, ascending.
struct Ends {
  std::vector<float> lower, upper, flat;  // flat: of those that begin where they end

  Ends(std::span<const Bounds3f> items, int axis) {
    for (const Bounds3f& b : items) {
      lower.push_back(b.lower[axis]);
      upper.push_back(b.upper[axis]);
      if (b.lower[axis] == b.upper[axis]) flat.push_back(b.lower[axis]);
    }
    for (auto* ends : {&lower, &upper, &flat}) std::sort(ends->begin(), ends->end());
  }
  double size() const { return double{upper.back()} - lower.front(); }
  // How many reach below and above c: what lies in it goes below.
  std::int64_t below(float c) const {
    const auto [from, to] = std::equal_range(flat.begin(), flat.end(), c);
    return std::lower_bound(lower.begin(), lower.end(), c) - lower.begin() + (to - from);
  }
  std::int64_t above(float c) const { return upper.end() - std::upper_bound(upper.begin(), upper.end(), c); }
};

std::vector<float> candidates_on(const Ends& ends, const Division& d) {
  std::vector<float> result;
  const double target = d.leaves_below / static_cast<double>(d.leaves_below + d.leaves_above);
  for (int k = -quantile_steps; k <= quantile_steps; ++k) {
    const double f = std::clamp(target * (1 + d.tolerance * k / quantile_steps), 0.0, 1.0);
    const auto at = static_cast<std::size_t>(f * static_cast<double>(ends.lower.size() - 1) + 0.5);
    result.insert(result.end(), {ends.lower[at], ends.upper[at]});
  }
  const float first = ends.lower.front(), last = ends.upper.back();
  for (int k = 1; k <= even_planes; ++k)
    result.push_back(static_cast<float>(first + ends.size() * k / (even_planes + 1)));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](float c) { return !(c > first && c < last); });
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

std::optional<Plane> choose_plane(std::span<const Bounds3f> all, const Division& division) {
  if (all.empty()) return {};
  std::vector<Bounds3f> items;
  const std::size_t stride = (all.size() + most_counted - 1) / most_counted;
  for (std::size_t i = 0; i < all.size(); i += stride) items.push_back(all[i]);
  const std::size_t n = items.size();
  const std::array<Ends, 3> ends{Ends(items, 0), Ends(items, 1), Ends(items, 2)};

  const auto side = [&](std::size_t a) { return ends[a % 3].size(); };
  const double half_surface = side(0) * side(1) + side(1) * side(2) + side(2) * side(0);
  const double leaves = division.leaves_below + division.leaves_above;
  std::optional<Plane> best;
  Score best_score;
  for (std::size_t a = 0; a < 3; ++a) {
    const double section = half_surface > 0 ? side(a + 1) * side(a + 2) / half_surface : 0;
    for (const float c : candidates_on(ends[a], division)) {
      const std::int64_t below = ends[a].below(c), above = ends[a].above(c);
      const double load = std::max(static_cast<double>(below) / division.leaves_below,
                                   static_cast<double>(above) / division.leaves_above);
      const double count = static_cast<double>(n), cut = static_cast<double>(below + above) - count;
      Score score{load / (count / leaves) - 1, 0};
      score.cost = section + 2 * cut / count + score.imbalance;
      if (below == 0 || above == 0 || !better(score, best_score, division.tolerance)) continue;
      best = Plane{static_cast<int>(a), c + 0.0f};
      best_score = score;
    }
  }
  return best;
}

}  // namespace vitrail
