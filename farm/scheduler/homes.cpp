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
Homes homes_by_work(const Manifest& manifest, const RayProfile& profile, int ranks, double bytes_share) {
  profile.require_of(manifest);
  constexpr double spread = .3;  // of a rank's share
  const auto domains = static_cast<std::uint32_t>(manifest.domains.size());
  std::vector<double> work(domains);
  double all_s = 0, all_bytes = 0;
  for (std::uint32_t d = 0; d < domains; ++d) {
    all_s += profile.domains[d].seconds;
    all_bytes += static_cast<double>(bytes_needed(manifest, d));
  }
  for (std::uint32_t d = 0; d < domains; ++d)
    work[d] = (all_s > 0 ? (1 - bytes_share) * profile.domains[d].seconds / all_s : 0) +
              bytes_share * static_cast<double>(bytes_needed(manifest, d)) / std::max(1.0, all_bytes);
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

std::optional<Homes> better_homes(const Manifest& manifest, const RayProfile& profile, const Homes& now,
                                  std::uint64_t bytes_a_rank) {
  constexpr double worth_moving = .9;  // of the work that the busiest rank has
  const bool must_fit = most_bytes_at_home(manifest, now) <= bytes_a_rank;
  for (const double bytes_share : {.02, .1, .2, .4}) {
    Homes homes = homes_by_work(manifest, profile, now.ranks(), bytes_share);
    if (must_fit && most_bytes_at_home(manifest, homes) > bytes_a_rank) continue;
    if (busiest_over_mean(homes, profile) > worth_moving * busiest_over_mean(now, profile)) break;
    return homes;
  }
  return std::nullopt;
}

std::uint64_t most_bytes_at_home(const Manifest& manifest, const Homes& homes) {
  std::vector<std::uint64_t> bytes(static_cast<std::size_t>(homes.ranks()));
  for (std::uint32_t d = 0; d < homes.domains(); ++d)
    for (int rank = homes.first(d); rank <= homes.last(d); ++rank)
      bytes[static_cast<std::size_t>(rank)] += bytes_needed(manifest, d);
  return std::ranges::max(bytes);
}

std::size_t domains_moved(const Homes& from, const Homes& to) {
  std::size_t moved = 0;
  for (std::uint32_t d = 0; d < from.domains(); ++d)
    moved += from.first(d) != to.first(d) || from.last(d) != to.last(d);
  return moved;
}

namespace {

// Whether the work fits where each rank may have this much. Homes lie in the order of the domains, so that
// filling the first ones first leaves the most for those behind.
bool has_room(const Homes& homes, const RayProfile& profile, double a_rank_s) {
  std::vector<double> room_s(static_cast<std::size_t>(homes.ranks()), a_rank_s);
  for (std::uint32_t d = 0; d < homes.domains(); ++d) {
    double left_s = profile.domains[d].seconds;
    for (int rank = homes.first(d); rank <= homes.last(d); ++rank) {
      double& room = room_s[static_cast<std::size_t>(rank)];
      const double here_s = std::min(room, left_s);
      room -= here_s;
      left_s -= here_s;
    }
    if (left_s > 0) return false;
  }
  return true;
}

}  // namespace

double busiest_over_mean(const Homes& homes, const RayProfile& profile) {
  double all_s = 0;
  for (const RayProfile::Domain& d : profile.domains) all_s += d.seconds;
  if (!(all_s > 0)) return 1;
  double too_little_s = 0, enough_s = all_s;
  for (int halving = 0; halving < 30; ++halving) {
    const double middle_s = (too_little_s + enough_s) / 2;
    (has_room(homes, profile, middle_s) ? enough_s : too_little_s) = middle_s;
  }
  return enough_s * homes.ranks() / all_s;
}

}  // namespace vitrail
