// SPDX-License-Identifier: Apache-2.0
#include "farm/conclude/gather_profile.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "farm/transport/list_to_root.h"

namespace vitrail {

namespace {

using Ways = std::map<std::uint64_t, std::uint64_t>;  // rays, by from << 32 | to

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

RayProfile gather_profile(Transport& transport, const Manifest& manifest, const RayTraffic& mine,
                          const RenderStats& stats) {
  std::vector<std::int64_t> visits(mine.visits().begin(), mine.visits().end());
  transport.sum_to_root(std::span(visits));
  std::vector<double> seconds = mine.seconds();
  transport.sum_to_root(std::span(seconds));
  // A few rays were timed; together all took trace_s.
  const double timed = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  for (double& s : seconds) s *= stats.trace_s / std::max(timed, 1e-9);
  std::vector<RayProfile::Way> ways;
  for (const auto& [way, rays] : gather_ways(transport, mine))
    ways.push_back({static_cast<std::uint32_t>(way >> 32), static_cast<std::uint32_t>(way), rays});
  const RayProfile::Cost cost{stats.traced.rays_camera, stats.trace_s, seconds.back(), stats.load_s,
                              stats.domain_loads};
  return {manifest, {visits.begin(), visits.end()}, seconds, std::move(ways), cost};
}

}  // namespace vitrail
