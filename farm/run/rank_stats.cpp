// SPDX-License-Identifier: Apache-2.0
#include "farm/run/rank_stats.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "farm/run/stats.h"

namespace vitrail {

namespace {

// A rank's numbers as they travel: its host's name first, then nanoseconds and counts.
constexpr std::size_t name_words = 8, times = 4, counts = 8;
using Row = std::array<std::int64_t, name_words + times + counts>;

Row row_of(const RenderStats& s) {
  Row row{};
  std::array<char, 8 * name_words> host{};
  ::gethostname(host.data(), host.size() - 1);
  std::memcpy(row.data(), host.data(), host.size());
  std::size_t at = name_words;
  for (const double time_s : {s.cpu_s, s.trace_s, s.load_s, s.idle_s}) row[at++] = std::llround(1e9 * time_s);
  for (const std::uint64_t count :
       {s.traced.rays_camera + s.traced.rays_indirect + s.traced.rays_shadow, s.domain_loads, s.evictions,
        s.forwarded_rays, s.forwarded_bytes, s.messages, s.spilled_bytes, s.peak_rss_bytes})
    row[at++] = static_cast<std::int64_t>(count);
  return row;
}

RankStats stats_of(std::span<const std::int64_t> row) {
  RankStats s;
  std::array<char, 8 * name_words> host{};
  std::memcpy(host.data(), row.data(), host.size() - 1);
  s.host = host.data();
  std::size_t at = name_words;
  for (double* time_s : {&s.cpu_s, &s.trace_s, &s.load_s, &s.idle_s})
    *time_s = 1e-9 * static_cast<double>(row[at++]);
  for (std::uint64_t* count : {&s.rays, &s.domain_loads, &s.evictions, &s.forwarded_rays, &s.forwarded_bytes,
                               &s.messages, &s.spilled_bytes, &s.peak_rss_bytes})
    *count = static_cast<std::uint64_t>(row[at++]);
  return s;
}

}  // namespace

std::vector<RankStats> gather_by_rank(Transport& transport, const RenderStats& mine) {
  const auto ranks = static_cast<std::size_t>(transport.size()),
             rank = static_cast<std::size_t>(transport.rank());
  const Row own = row_of(mine);
  std::vector<std::int64_t> rows(ranks * own.size());
  std::ranges::copy(own, rows.begin() + static_cast<std::ptrdiff_t>(rank * own.size()));
  transport.sum_to_root(std::span(rows));  // the others' are zero
  std::vector<RankStats> all;
  if (rank == 0)
    for (std::size_t i = 0; i < ranks; ++i)
      all.push_back(stats_of(std::span(rows).subspan(i * own.size(), own.size())));
  return all;
}

nlohmann::ordered_json to_json(const std::vector<RankStats>& ranks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const RankStats& s = ranks[i];
    list.push_back({{"rank", i},
                    {"host", s.host},
                    {"cpu_s", s.cpu_s},
                    {"trace_s", s.trace_s},
                    {"load_s", s.load_s},
                    {"idle_s", s.idle_s},
                    {"rays", s.rays},
                    {"domain_loads", s.domain_loads},
                    {"evictions", s.evictions},
                    {"forwarded_rays", s.forwarded_rays},
                    {"forwarded_bytes", s.forwarded_bytes},
                    {"messages", s.messages},
                    {"spilled_bytes", s.spilled_bytes},
                    {"peak_rss_bytes", s.peak_rss_bytes}});
  }
  return list;
}

}  // namespace vitrail
