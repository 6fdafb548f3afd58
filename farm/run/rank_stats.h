// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "farm/transport/transport.h"

namespace vitrail {

struct RenderStats;

// It says what one rank did, and where: whether some are slower, fuller or idler than others.
struct RankStats {
  std::string host;  // its first 63 bytes
  double cpu_s = 0, trace_s = 0, load_s = 0, idle_s = 0;
  std::uint64_t rays = 0, domain_loads = 0, evictions = 0;
  std::uint64_t forwarded_rays = 0, forwarded_bytes = 0, messages = 0, spilled_bytes = 0, peak_rss_bytes = 0;
};

// Returns on rank 0 one entry of each rank, in their order, elsewhere none. All ranks call it together, each
// with its own statistics.
std::vector<RankStats> gather_by_rank(Transport& transport, const RenderStats& mine);

nlohmann::ordered_json to_json(const std::vector<RankStats>& ranks);

}  // namespace vitrail
