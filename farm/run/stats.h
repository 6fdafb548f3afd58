// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "farm/plan/rounds.h"
#include "farm/run/rank_stats.h"
#include "farm/transport/transport.h"
#include "tracer/transport/tracing.h"

namespace vitrail {

// It says how a job came to its end.
enum class Ending { none, finished, time_is_up, interrupted, terminated };
// Returns whether the end is written as a film rather than a checkpoint.
constexpr bool writes_film(Ending e) { return e == Ending::finished || e == Ending::time_is_up; }

// It tells what came of homes that settled (run/settling.h).
struct Settled {
  double at_s = 0;             // since rendering began; 0: they did not
  std::uint64_t domains = 0;   // that moved
  std::uint64_t rays = 0;      // that waited for a domain which moved, and were sent on to its new home
  double trace_s = 0;          // since then, of all ranks
  double busiest_trace_s = 0;  // and of the rank that traced longest since then
};

// It holds the statistics of a render, of one rank and, after `gather_stats`, of the job: sums, and maxima
// for the memory.
struct RenderStats {
  int ranks = 1, threads = 1, spectral_bins = 0;
  std::uint64_t spp = 0, seed = 0, samples = 0;
  double wall_s = 0, cpu_s = 0, load_s = 0, trace_s = 0, idle_s = 0;
  double busiest_trace_s = 0;  // of the rank that traced longest
  Settled settled;
  // They are the seconds of checkpoints in the midst of the job, from the moment from which no ray is born
  // until work goes on: of all, and of the longest.
  double checkpoint_s = 0, longest_checkpoint_s = 0;
  TraceCounters traced;
  bool adaptive = false;
  int rounds = 0;            // of samples, begun by this run
  TargetError target;        // value 0: none
  ReachedError reached;      // where there is a target
  double clamped_share = 0;  // Film's
  Refused refused;           // deposits; those of earlier runs of the job included
  std::uint64_t forwarded_rays = 0, forwarded_bytes = 0, messages = 0;
  std::uint64_t domains_total = 0, domains_touched = 0, domain_loads = 0, evictions = 0;
  std::uint64_t spilled_bytes = 0;  // of rays, to the disk
  std::uint64_t tiles_read = 0;     // of textures, from their files
  std::uint64_t items_given = 0;    // from rank to rank
  std::uint64_t checkpoints = 0;
  // They are for photon mapping: landings of all iterations, and most of an iteration that a rank kept.
  std::uint64_t photons_landed = 0, photons_kept = 0;
  std::uint64_t memory_budget_bytes = 0, peak_rss_bytes = 0, base_rss_bytes = 0, setup_peak_rss_bytes = 0;
  std::uint64_t film_hash = 0;
  Ending ending = Ending::none;
  std::uint64_t pixels = 0;             // of the film
  std::uint64_t film_window_bytes = 0;  // of rank 0: what of a film in files is in memory; 0: all of it is
  std::string command;                  // that was typed; empty: unknown
  std::vector<RankStats> by_rank;
  bool finished_before = false;  // nothing was left to do
  double expected_s = 0;         // of a dry run: how long all that is left takes
};

// Gathers the job's statistics on rank 0; all ranks call it together. `touched` has a bit a domain, of this
// rank.
void gather_stats(Transport& transport, RenderStats& stats, const std::vector<bool>& touched);
// Gathers peak_rss_bytes anew, the job's and each rank's. All ranks call it together, when no more memory
// will be used.
void gather_peaks(Transport& transport, RenderStats& stats);

// Returns one JSON object with the keys of the stats contract; flat but for "hosts" and "by_rank".
std::string to_json(const RenderStats& stats);

}  // namespace vitrail
