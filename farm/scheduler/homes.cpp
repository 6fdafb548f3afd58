// SPDX-License-Identifier: Apache-2.0
#include "farm/scheduler/homes.h"

#include <algorithm>
#include <numeric>

namespace vitrail {

std::uint64_t Homes::places() const {
  std::uint64_t sum = 0;
  for (std::size_t d = 0; d < first_.size(); ++d) sum += static_cast<std::uint64_t>(last_[d] - first_[d] + 1);
  return sum;
}

Homes homes_by_bytes(const Manifest& manifest, int ranks) {
  std::uint64_t total = 0;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d) total += bytes_needed(manifest, d);
  std::vector<int> home;
  std::uint64_t before = 0;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d) {
    const std::uint64_t bytes = bytes_needed(manifest, d), middle = before + bytes / 2;
    home.push_back(total == 0 ? 0
                              : std::min(ranks - 1, static_cast<int>(
                                                        middle * static_cast<std::uint64_t>(ranks) / total)));
    before += bytes;
  }
  return Homes(home, ranks);
}

// The domains lie in a row of the ranks' length, each as long as its work, and reach a little further, so
// that what lies near a border can go to either side. Those that no ray met count a little, by their bytes:
// the whole picture may go there.
Homes homes_by_work(const Manifest& manifest, const RayProfile& profile, int ranks) {
  profile.require_of(manifest);
  constexpr double unseen_share = .02;
  constexpr double spread = .3;  // of a rank's share
  const auto domains = static_cast<std::uint32_t>(manifest.domains.size());
  std::vector<double> work(domains);
  double all_s = 0, all_bytes = 0;
  for (std::uint32_t d = 0; d < domains; ++d) {
    all_s += profile.domains[d].seconds;
    all_bytes += static_cast<double>(bytes_needed(manifest, d));
  }
  for (std::uint32_t d = 0; d < domains; ++d)
    work[d] = (all_s > 0 ? (1 - unseen_share) * profile.domains[d].seconds / all_s : 0) +
              unseen_share * static_cast<double>(bytes_needed(manifest, d)) / std::max(1.0, all_bytes);
  const double total = std::accumulate(work.begin(), work.end(), 0.0);
  std::vector<int> first(domains), last(domains);
  double before = 0;
  const auto rank_at = [&](double at) {
    return total > 0 ? std::clamp(static_cast<int>(at / total * ranks), 0, ranks - 1) : 0;
  };
  const double beyond = spread * total / ranks;
  for (std::uint32_t d = 0; d < domains; ++d) {
    first[d] = rank_at(before - beyond);
    last[d] = rank_at(before + work[d] + beyond);
    before += work[d];
  }
  return Homes(std::move(first), std::move(last), ranks);
}

}  // namespace vitrail
