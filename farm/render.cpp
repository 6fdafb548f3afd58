// SPDX-License-Identifier: Apache-2.0
#include "farm/render.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "farm/conclude/gather_timeline.h"
#include "farm/conclude/job_report.h"
#include "farm/files/crashes.h"
#include "farm/files/signals.h"
#include "farm/plan/job.h"
#include "farm/plan/same_job.h"
#include "farm/run/file_watch.h"
#include "farm/run/gather_profile.h"
#include "farm/run/rank.h"
#include "farm/run/settle_homes.h"
#include "farm/run/workers.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "scene/system/resource_usage.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

namespace vitrail {

namespace {

bool has_light(const Manifest& m) {
  return !m.lights.empty() || !m.area_lights.empty() ||
         std::ranges::any_of(m.media, [](const Medium& medium) { return medium.emission.has_value(); });
}

// Only what is read tells how much memory the job needs. What would be killed before ends with a message.
Job set_up_within(const RenderOptions& options, const Place& place) {
  Job job;
  within_job(options.resources.job_bytes, "reading the scene", [&] { job = set_up(options, place); });
  return job;
}

// Returns the statistics of this rank.
RenderStats run(Transport& transport, const RenderOptions& options, Job& job, RankState& state, Rank& rank,
                bool finished_before) {
  const Manifest& manifest = job.scene->manifest;
  const bool is_root = transport.rank() == 0;
  RenderStats stats;
  add_plan(stats, job, options, transport.size());
  stats.finished_before = finished_before;
  if (is_root && !options.outputs.quiet && !has_light(manifest))
    say("vitrail: the scene has no light: its picture is black; add a lamp, or give --sky "
        "LATITUDE,LONGITUDE,TIME "
        "where the scene is partitioned\n");
  if (finished_before) {
    stats.ending = Ending::finished;
  } else {
    if (is_root) print_start(options, manifest, job.plan.goal, transport.size(), job.plan.threads);
    const auto work = [&] {
      std::optional<Workers> workers;
      try {
        workers.emplace(state, job.plan.threads);
      } catch (...) {
        fail(state, std::current_exception());  // the next round tells all
      }
      return rank.run();
    };
    while ((stats.ending = work()) == Ending::none) settle_homes(transport, state, job, options, stats);
    stats.rounds = rank.rounds();
  }
  rank.add_to(stats);
  return stats;
}

}  // namespace

RenderStats render(Transport& transport, const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  ::mallopt(M_ARENA_MAX, 2);  // an arena a thread would keep memory that the budget does not know of
  catch_signals();
  catch_crashes();
  // Plan.
  now_doing("reading the scene");
  Job job;
  agree(transport, [&] { job = set_up_within(options, {transport.rank(), transport.size()}); });
  const Manifest& manifest = job.scene->manifest;
  expect_same_job(transport, manifest, job.plan.key, job.plan.goal, job.plan.homes, options);
  require_all_may_settle(transport, job.plan);
  EarlierWork earlier = read_earlier_work(transport, options, job.film, job.plan.goal, job.about);
  const std::uint64_t samples_before = job.film.samples();  // on rank 0
  // Run.
  now_doing("beginning to render");
  const FileWatch file_watch(
      transport.size() > 1 ? fmt::format("rank {} of {}: ", transport.rank(), transport.size()) : "");
  RankState state(*job.scene, job.film, std::move(earlier.plan), job.plan, options);
  const bool finished_before = earlier.finished;
  Rank rank(transport, state, options, job, std::move(earlier));
  RenderStats stats = run(transport, options, job, state, rank, finished_before);
  stats.peak_rss_bytes = peak_resident_bytes();
  stats.cpu_s = cpu_seconds();
  stats.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // Conclude.
  now_doing("writing the statistics");
  gather_stats(transport, stats, state.domains.touched());
  std::optional<RayProfile> profile;
  if (!options.outputs.profile.empty())
    profile = gather_profile(transport, manifest, *state.work.profiling, stats);
  agree(transport, [&] {  // what fails on rank 0 ends the job everywhere
    if (transport.rank() == 0) conclude(job, options, samples_before, profile, stats);
  });
  std::exception_ptr no_trace;  // on all ranks or on none; the statistics are written all the same
  try {
    if (state.work.timeline)
      write_timelines(transport, *state.work.timeline, job.plan.threads, start, options.outputs.trace);
  } catch (...) {
    no_trace = std::current_exception();
  }
  gather_peaks(transport, stats);
  agree(transport, [&] {
    if (transport.rank() == 0) write_stats(options, stats);
  });
  if (no_trace) std::rethrow_exception(no_trace);
  return stats;
}

}  // namespace vitrail
