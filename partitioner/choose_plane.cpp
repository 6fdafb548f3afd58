// SPDX-License-Identifier: Apache-2.0
#include "partitioner/choose_plane.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vitrail {

namespace {

constexpr std::size_t sample_size = 8192;  // quantiles are known to about 0.6 %
constexpr int quantile_steps = 8;          // on each side of the balanced split
constexpr int even_planes = 16;

using Range = tbb::blocked_range<std::size_t>;

// Extents of the i-th of all triangles and pieces.
struct Extents {
  const CellContent& content;
  std::span<const Triangle> triangles;
  Interval operator()(std::size_t i, int axis) const {
    if (i < content.whole.size()) return interval(triangles[content.whole[i]], axis);
    return interval(content.polygon(content.pieces[i - content.whole.size()]), axis);
  }
};

// For candidates c₀ < c₁ < …: how many reach below and above each, as differences to be summed over the
// candidates.
struct Histogram {
  std::vector<float> candidates;               // ascending
  std::vector<std::int64_t> below{}, above{};  // one more than candidates

  void count(Interval i) {
    const auto first = candidates.begin();
    // Below c: lower < c, or all of it in c.
    auto from = std::upper_bound(first, candidates.end(), i.lower);
    if (i.lower == i.upper && from != first && from[-1] == i.lower) --from;
    ++below[static_cast<std::size_t>(from - first)];
    // Above c: upper > c.
    ++above[static_cast<std::size_t>(std::lower_bound(first, candidates.end(), i.upper) - first)];
  }
};

using Histograms = std::array<Histogram, 3>;

std::vector<float> candidates_on(const Extents& extents, int axis, const Interval& bounds,
                                 const Division& d) {
  const std::size_t n = extents.content.size(), stride = (n + sample_size - 1) / sample_size;
  std::vector<float> lower, upper;
  for (std::size_t i = 0; i < n; i += stride) {
    const Interval e = extents(i, axis);
    lower.push_back(static_cast<float>(e.lower));
    upper.push_back(static_cast<float>(e.upper));
  }
  std::sort(lower.begin(), lower.end());
  std::sort(upper.begin(), upper.end());
  std::vector<float> result;
  const double target = d.leaves_below / static_cast<double>(d.leaves_below + d.leaves_above);
  for (int k = -quantile_steps; k <= quantile_steps; ++k) {
    const double f = std::clamp(target * (1 + d.tolerance * k / quantile_steps), 0.0, 1.0);
    const auto at = static_cast<std::size_t>(f * static_cast<double>(lower.size() - 1) + 0.5);
    result.insert(result.end(), {lower[at], upper[at]});
  }
  for (int k = 1; k <= even_planes; ++k)
    result.push_back(
        static_cast<float>(bounds.lower + (bounds.upper - bounds.lower) * k / (even_planes + 1)));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](float c) { return !(c > bounds.lower && c < bounds.upper); });
  return result;
}

Histograms count_all(const Extents& extents, const Histograms& empty) {
  return tbb::parallel_reduce(
      Range(0, extents.content.size(), 16384), empty,
      [&](const Range& range, Histograms h) {
        for (int axis = 0; axis < 3; ++axis)
          for (std::size_t i = range.begin(); i != range.end(); ++i)
            h[static_cast<std::size_t>(axis)].count(extents(i, axis));
        return h;
      },
      [](Histograms a, const Histograms& b) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (std::size_t i = 0; i < a[axis].below.size(); ++i) {
            a[axis].below[i] += b[axis].below[i];
            a[axis].above[i] += b[axis].above[i];
          }
        return a;
      });
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

std::optional<Plane> choose_plane(const CellContent& content, std::span<const Triangle> triangles,
                                  const Division& division) {
  const Extents extents{content, triangles};
  const std::size_t n = content.size();
  if (n == 0) return {};
  std::array<Interval, 3> box;
  Histograms empty;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    box[a] = extents(0, axis);
    for (std::size_t i = 1; i < n; ++i) {
      const Interval e = extents(i, axis);
      box[a] = {std::min(box[a].lower, e.lower), std::max(box[a].upper, e.upper)};
    }
    empty[a].candidates = candidates_on(extents, axis, box[a], division);
    empty[a].below.assign(empty[a].candidates.size() + 1, 0);
    empty[a].above.assign(empty[a].candidates.size() + 1, 0);
  }
  const Histograms counts = count_all(extents, empty);

  const auto side = [&](std::size_t a) { return box[a % 3].upper - box[a % 3].lower; };
  const double half_surface = side(0) * side(1) + side(1) * side(2) + side(2) * side(0);
  const double leaves = division.leaves_below + division.leaves_above;
  std::optional<Plane> best;
  Score best_score;
  for (std::size_t a = 0; a < 3; ++a) {
    const double section = half_surface > 0 ? side(a + 1) * side(a + 2) / half_surface : 0;
    std::int64_t below = 0, above = static_cast<std::int64_t>(n);
    for (std::size_t k = 0; k < counts[a].candidates.size(); ++k) {
      below += counts[a].below[k];
      above -= counts[a].above[k];
      const double load = std::max(static_cast<double>(below) / division.leaves_below,
                                   static_cast<double>(above) / division.leaves_above);
      const double count = static_cast<double>(n), cut = static_cast<double>(below + above) - count;
      Score score{load / (count / leaves) - 1, 0};
      score.cost = section + 2 * cut / count + score.imbalance;
      if (below == 0 || above == 0 || !better(score, best_score, division.tolerance)) continue;
      best = Plane{static_cast<int>(a), counts[a].candidates[k] + 0.0f};
      best_score = score;
    }
  }
  return best;
}

}  // namespace vitrail
