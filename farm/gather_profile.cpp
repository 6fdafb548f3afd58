// SPDX-License-Identifier: Apache-2.0
#include "farm/gather_profile.h"

#include <algorithm>

namespace vitrail {

// One domain that rays come from after the other: ways are few, but any pair may be one.
RayProfile gather_profile(Transport& transport, const Manifest& manifest, const RayTraffic& mine,
                          const RenderStats& stats) {
  const auto domains = static_cast<std::uint32_t>(manifest.domains.size());
  std::vector<std::int64_t> visits(mine.visits().begin(), mine.visits().end());
  transport.sum_to_root(std::span(visits));
  std::vector<std::pair<std::uint64_t, std::uint64_t>> sorted(mine.ways().begin(), mine.ways().end());
  std::ranges::sort(sorted);
  std::vector<RayProfile::Way> ways;
  auto next = sorted.begin();
  std::vector<std::int64_t> to(domains);
  for (std::uint32_t i = 0; i <= domains; ++i) {
    const std::uint32_t from = i < domains ? i : RayProfile::Way::camera;
    std::ranges::fill(to, 0);
    for (; next != sorted.end() && next->first >> 32 == from; ++next)
      to[static_cast<std::uint32_t>(next->first)] = static_cast<std::int64_t>(next->second);
    transport.sum_to_root(std::span(to));
    for (std::uint32_t d = 0; d < domains; ++d)
      if (to[d] > 0) ways.push_back({from, d, static_cast<std::uint64_t>(to[d])});
  }
  const RayProfile::Cost cost{stats.traced.rays_camera, stats.trace_s, stats.load_s, stats.domain_loads};
  return {manifest, {visits.begin(), visits.end()}, std::move(ways), cost};
}

}  // namespace vitrail
