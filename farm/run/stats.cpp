// SPDX-License-Identifier: Apache-2.0
#include "farm/run/stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "film/renderer_version.h"
#include "scene/system/resource_usage.h"
#include "tracer/photons/photon_map.h"

namespace vitrail {

void gather_stats(Transport& transport, RenderStats& s, const std::vector<bool>& touched) {
  s.by_rank = gather_by_rank(transport, s);
  std::uint64_t* const summed[] = {&s.traced.rays_camera,
                                   &s.traced.rays_indirect,
                                   &s.traced.rays_shadow,
                                   &s.traced.crossings,
                                   &s.forwarded_rays,
                                   &s.forwarded_bytes,
                                   &s.messages,
                                   &s.domain_loads,
                                   &s.evictions,
                                   &s.spilled_bytes,
                                   &s.tiles_read,
                                   &s.items_given,
                                   &s.settled.rays,
                                   &s.traced.photons_emitted,
                                   &s.traced.gathers,
                                   &s.traced.photons_gathered,
                                   &s.photons_landed,
                                   &s.traced.connections_in_glass,
                                   &s.traced.connections_in_wedges};
  std::vector<std::int64_t> counts;
  for (const std::uint64_t* value : summed) counts.push_back(static_cast<std::int64_t>(*value));
  transport.sum_to_root(std::span(counts));
  for (std::size_t i = 0; i < counts.size(); ++i) *summed[i] = static_cast<std::uint64_t>(counts[i]);

  std::vector<std::int64_t> anywhere(touched.begin(), touched.end());
  transport.max_to_root(anywhere);
  s.domains_touched = static_cast<std::uint64_t>(std::ranges::count(anywhere, 1));

  std::int64_t busiest_ns[] = {static_cast<std::int64_t>(1e9 * s.trace_s),
                               static_cast<std::int64_t>(1e9 * s.settled.trace_s)};
  transport.max_to_root(busiest_ns);
  s.busiest_trace_s = 1e-9 * static_cast<double>(busiest_ns[0]);
  s.settled.busiest_trace_s = 1e-9 * static_cast<double>(busiest_ns[1]);

  double times[] = {s.cpu_s, s.load_s, s.trace_s, s.idle_s, s.settled.trace_s};
  transport.sum_to_root(std::span(times));
  s.cpu_s = times[0];
  s.load_s = times[1];
  s.trace_s = times[2];
  s.idle_s = times[3];
  s.settled.trace_s = times[4];

  std::int64_t memory[] = {
      static_cast<std::int64_t>(s.peak_rss_bytes), static_cast<std::int64_t>(s.base_rss_bytes),
      static_cast<std::int64_t>(s.setup_peak_rss_bytes), static_cast<std::int64_t>(s.photons_kept),
      static_cast<std::int64_t>(s.traced.widest_wedge_nrad)};
  transport.max_to_root(memory);
  s.peak_rss_bytes = static_cast<std::uint64_t>(memory[0]);
  s.base_rss_bytes = static_cast<std::uint64_t>(memory[1]);
  s.setup_peak_rss_bytes = static_cast<std::uint64_t>(memory[2]);
  s.photons_kept = static_cast<std::uint64_t>(memory[3]);
  s.traced.widest_wedge_nrad = static_cast<std::uint64_t>(memory[4]);
}

void gather_peaks(Transport& transport, RenderStats& s) {
  std::vector<std::int64_t> peaks(static_cast<std::size_t>(transport.size()));
  peaks[static_cast<std::size_t>(transport.rank())] = static_cast<std::int64_t>(peak_resident_bytes());
  transport.max_to_root(peaks);
  s.peak_rss_bytes = static_cast<std::uint64_t>(std::ranges::max(peaks));
  for (std::size_t i = 0; i < s.by_rank.size(); ++i)
    s.by_rank[i].peak_rss_bytes = static_cast<std::uint64_t>(peaks[i]);
}

std::string to_json(const RenderStats& s) {
  std::set<std::string> hosts;
  for (const RankStats& rank : s.by_rank) hosts.insert(rank.host);
  nlohmann::ordered_json json = {{"command", s.command},
                                 {"version", to_string(this_renderer())},
                                 {"hosts", hosts},
                                 {"ranks", s.ranks},
                                 {"threads", s.threads},
                                 {"spp", s.spp},
                                 {"seed", s.seed},
                                 {"samples", s.samples},
                                 {"spectral_bins", s.spectral_bins},
                                 {"complete", s.ending == Ending::finished},
                                 {"wall_s", s.wall_s},
                                 {"cpu_s", s.cpu_s},
                                 {"load_s", s.load_s},
                                 {"trace_s", s.trace_s},
                                 {"busiest_trace_s", s.busiest_trace_s},
                                 {"idle_s", s.idle_s},
                                 {"settled_s", s.settled.at_s},
                                 {"domains_moved", s.settled.domains},
                                 {"settled_rays", s.settled.rays},
                                 {"settled_trace_s", s.settled.trace_s},
                                 {"busiest_settled_trace_s", s.settled.busiest_trace_s},
                                 {"rays_camera", s.traced.rays_camera},
                                 {"rays_indirect", s.traced.rays_indirect},
                                 {"rays_shadow", s.traced.rays_shadow},
                                 {"crossings", s.traced.crossings},
                                 {"forwarded_rays", s.forwarded_rays},
                                 {"forwarded_bytes", s.forwarded_bytes},
                                 {"messages", s.messages},
                                 {"domains_total", s.domains_total},
                                 {"domains_touched", s.domains_touched},
                                 {"domain_loads", s.domain_loads},
                                 {"evictions", s.evictions},
                                 {"spilled_bytes", s.spilled_bytes},
                                 {"tiles_read", s.tiles_read},
                                 {"items_given", s.items_given},
                                 {"checkpoints", s.checkpoints},
                                 {"checkpoint_s", s.checkpoint_s},
                                 {"longest_checkpoint_s", s.longest_checkpoint_s},
                                 {"memory_budget_bytes", s.memory_budget_bytes},
                                 {"peak_rss_bytes", s.peak_rss_bytes},
                                 {"base_rss_bytes", s.base_rss_bytes},
                                 {"setup_peak_rss_bytes", s.setup_peak_rss_bytes},
                                 {"film_window_bytes", s.film_window_bytes},
                                 {"nonfinite_samples", s.refused.nonfinite},
                                 {"saturated_samples", s.refused.too_large},
                                 {"clamped_share", s.clamped_share},
                                 {"film_hash", fmt::format("{:016x}", s.film_hash)}};
  json["by_rank"] = to_json(s.by_rank);
  json["photons_emitted"] = s.traced.photons_emitted;
  json["photons_landed"] = s.photons_landed;
  json["photon_gathers"] = s.traced.gathers;
  json["photons_gathered"] = s.traced.photons_gathered;
  json["photon_bytes"] = s.photons_kept * PhotonMap::photon_bytes;
  json["connections_in_glass"] = s.traced.connections_in_glass;
  json["connections_in_wedges"] = s.traced.connections_in_wedges;
  json["widest_wedge_rad"] = 1e-9 * static_cast<double>(s.traced.widest_wedge_nrad);
  json["adaptive"] = s.adaptive;
  json["rounds"] = s.rounds;
  if (s.target.value > 0) {
    json["target_error"] = s.target.value;
    json["target_error_unit"] = s.target.just_noticeable ? "jnd" : "relmse";
    json["reached_error"] = s.reached.estimate;
    json["reached_error_upper"] = s.reached.upper;
    json["target_reached"] = s.reached.upper <= s.target.value;
  }
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace vitrail
