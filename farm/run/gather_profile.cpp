// SPDX-License-Identifier: Apache-2.0
#include "farm/run/gather_profile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "farm/transport/list_to_root.h"

namespace vitrail {

namespace {

using Ways = std::map<std::uint64_t, std::uint64_t>;  // rays, by from << 32 | to

std::uint64_t way_of(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }

// Ways are few, though any pair of domains may be one. Whole on rank 0.
Ways gather_ways(Transport& transport, const RayTraffic& mine) {
  Ways all;
  for (int rank = 0; rank < transport.size(); ++rank) {
    std::vector<std::int64_t> list;
    if (rank == transport.rank())
      for (const auto& [way, rays] : mine.ways()) {
        list.push_back(static_cast<std::int64_t>(way));
        list.push_back(static_cast<std::int64_t>(rays));
      }
    list = list_to_root(transport, rank, std::move(list));
    for (std::size_t i = 0; i < list.size(); i += 2)
      all[static_cast<std::uint64_t>(list[i])] += static_cast<std::uint64_t>(list[i + 1]);
  }
  return all;
}

}  // namespace

RayProfile gather_profile(Transport& transport, const Manifest& manifest, const Profiling& mine,
                          const RenderStats& stats) {
  auto sums = mine.sums;
  transport.sum_to_root(std::span<double>(sums));
  const double walking_s = Profiling::seconds_of_all(sums, Profiling::Manner::walking),
               of_one = Profiling::samples_a_recorded_one(sums);
  std::vector<double> seconds = mine.traffic.seconds();
  transport.sum_to_root(std::span(seconds));
  // A few rays were timed; these are their shares.
  const double timed = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  for (double& s : seconds) s *= walking_s / std::max(timed, 1e-9);
  std::vector<std::int64_t> traced(mine.traffic.visits().begin(), mine.traffic.visits().end());
  transport.sum_to_root(std::span(traced));
  // Every ray that is traced in a domain came there by a way.
  Ways recorded = gather_ways(transport, mine.traffic);
  std::vector<bool> is_entered(traced.size());
  for (const auto& [way, rays] : recorded) is_entered[static_cast<std::uint32_t>(way)] = true;
  // Where only tasks that nobody recorded sent some, they stand as the camera's: none goes on from nowhere.
  for (std::uint32_t d = 0; d < traced.size(); ++d)
    if (!is_entered[d] && traced[d] > 0)
      recorded[way_of(RayProfile::Way::camera, d)] = static_cast<std::uint64_t>(traced[d]);
  std::vector<std::uint64_t> visits(traced.size());
  std::vector<RayProfile::Way> ways;
  for (const auto& [way, of_some] : recorded) {
    const auto rays = static_cast<std::uint64_t>(std::llround(of_one * static_cast<double>(of_some)));
    const auto to = static_cast<std::uint32_t>(way);
    ways.push_back({static_cast<std::uint32_t>(way >> 32), to, rays});
    visits[to] += rays;
  }
  const RayProfile::Cost cost{stats.traced.rays_camera,
                              Profiling::seconds_of_all(sums, Profiling::Manner::plain), seconds.back(),
                              stats.load_s, stats.domain_loads};
  return {manifest, visits, seconds, std::move(ways), cost};
}

}  // namespace vitrail
