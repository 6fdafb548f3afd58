// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/block_means.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrail::test {

namespace {

struct Estimate {
  double mean = 0, variance = 0;  // of the mean
};

Estimate estimate(const std::vector<BlockMeans>& seeds, std::size_t i) {
  Estimate e;
  const auto n = static_cast<double>(seeds.size());
  for (const BlockMeans& seed : seeds) e.mean += seed[i] / n;
  for (const BlockMeans& seed : seeds) e.variance += (seed[i] - e.mean) * (seed[i] - e.mean) / (n - 1) / n;
  return e;
}

double mean_of_picture(const std::vector<BlockMeans>& seeds) {
  double sum = 0;
  for (const BlockMeans& seed : seeds)
    for (const double v : seed) sum += v;
  return sum / static_cast<double>(seeds.size() * seeds.front().size());
}

}  // namespace

BlockMeans block_means(const Film& film) {
  BlockMeans means(static_cast<std::size_t>(3 * blocks_a_side * blocks_a_side));
  const int width = film.width() / blocks_a_side, height = film.height() / blocks_a_side;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const XYZ value = film.mean(static_cast<std::uint32_t>(y * film.width() + x));
      double* block = &means[static_cast<std::size_t>(3 * (y / height * blocks_a_side + x / width))];
      block[0] += value.x / (width * height);
      block[1] += value.y / (width * height);
      block[2] += value.z / (width * height);
    }
  return means;
}

std::string difference_of_means(const std::vector<BlockMeans>& a, const std::vector<BlockMeans>& b,
                                const Tolerance& tolerance) {
  const double picture = std::max(mean_of_picture(a), mean_of_picture(b));
  double worst = 1;
  std::string text;
  for (std::size_t i = 0; i < a.front().size(); ++i) {
    const Estimate x = estimate(a, i), y = estimate(b, i);
    const double may = tolerance.standard_errors * std::sqrt(x.variance + y.variance) +
                       tolerance.relative * std::max(x.mean, y.mean) + tolerance.of_picture * picture;
    const double off = std::abs(x.mean - y.mean);
    if (off <= worst * may) continue;
    worst = off / std::max(may, 1e-30);
    text = fmt::format("{} of block {}, {}: {:.4f} against {:.4f}, {:.1f} times what may be", "XYZ"[i % 3],
                       i / 3 % blocks_a_side, i / 3 / blocks_a_side, x.mean, y.mean, worst);
  }
  return text;
}

}  // namespace vitrail::test
