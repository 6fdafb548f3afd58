// SPDX-License-Identifier: Apache-2.0
#include "farm/run/rank.h"

#include <algorithm>
#include <csignal>
#include <thread>

#include "farm/files/signals.h"
#include "farm/scheduler/nap.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

using Clock = RankState::Clock;
using namespace std::chrono_literals;

// Into the timeline, where one is recorded.
void note_counters(const Locked&, RankState& state, std::int64_t rays_waiting, Clock::time_point& last) {
  constexpr auto interval = 50ms;
  const auto now = Clock::now();
  if (!state.work.timeline || now - last < interval) return;
  last = now;
  const Residency& domains = state.scheduler.residency();
  state.work.timeline->add(Timeline::Kind::counters, 0, now, now,
                           {rays_waiting, static_cast<std::int64_t>(state.scheduler.rays_to_send()),
                            static_cast<std::int64_t>(domains.loads() - domains.evictions()),
                            static_cast<std::int64_t>(domains.held_bytes())});
}

// How the job ends where it is told to.
Ending stop_of(const RoundSums& sums) {
  if (sums.terminated > 0) return Ending::terminated;
  if (sums.interrupted > 0) return Ending::interrupted;
  return sums.time_is_up > 0 ? Ending::time_is_up : Ending::none;
}

}  // namespace

Rank::Rank(Transport& transport, RankState& state, const RenderOptions& options, Job& job,
           EarlierWork earlier)
    : transport_(transport),
      state_(state),
      options_(options),
      goal_(job.plan.goal),
      progress_(options, transport.rank(), state.film, expected_samples(state.film, goal_)),
      phases_(state, {transport.rank(), transport.size()}, std::move(earlier.done)),
      exchange_(transport, state, phases_, job.plan.queues.being_sent),
      checkpointing_(transport, state, options, job.keeper.get(), job.about, earlier.render_time_s),
      settling_(job.plan, options),
      stall_(options.resources.patience_s) {}

Ending Rank::run() {
  Nap nap;
  const std::chrono::duration<double> round_interval(round_interval_s(transport_.size()));
  Clock::time_point last_round;
  bool in_round = false;
  now_doing("tracing rays");
  for (;;) {
    bool moved = exchange_.move();
    checkpointing_.watch_clock();
    transport_.goes_on();
    if (in_round) {
      if (const auto round = transport_.finish_round()) {
        in_round = false;
        if (const std::optional<Ending> ending = after_round(*round)) return *ending;
      }
    } else if (Clock::now() - last_round >= round_interval) {
      last_round = Clock::now();
      join_round();
      in_round = moved = true;
    }
    if (moved)
      nap.moved();
    else
      std::this_thread::sleep_for(nap.take());
  }
}

void Rank::join_round() {
  const Locked locked(state_);
  RoundSums mine = state_.scheduler.contribution();
  const RankReport report = state_.scheduler.report();
  note_counters(locked, state_, report.waiting, last_counters_);
  mine.pause = checkpointing_.wanted();
  mine.interrupted = stop_signal() == SIGINT;
  mine.terminated = stop_signal() == SIGTERM;
  mine.time_is_up = checkpointing_.time_is_up();
  mine.profiles = settling_.profiles();
  mine.settles = settling_.settles(state_.elapsed_s());
  mine.working = !state_.scheduler.all_workers_wait() || state_.loads_under_way > 0;
  if (state_.failure) (is_bad_input(state_.failure) ? mine.bad_input : mine.machine_failure) = 1;
  const TraceCounters& c = state_.work.counters;
  mine.samples = static_cast<std::int64_t>(c.rays_camera);
  mine.items_done += phases_.items_done_before();
  mine.rays_traced = static_cast<std::int64_t>(c.rays_camera + c.rays_indirect + c.rays_shadow);
  transport_.start_round(mine, report);
}

// How the render ends, where it does.
std::optional<Ending> Rank::after_round(const Round& round) {
  progress_.show(round);
  if (transport_.rank() == 0) watch_settling(round.sums);
  const Decision decision = decide(round);
  if (decision == Decision::go_on) {
    watch_for_stall(round.sums);
    return std::nullopt;
  }
  const std::optional<Ending> ending = act_on(decision, round.sums);
  now_doing("tracing rays");
  return ending;
}

void Rank::watch_settling(const RoundSums& sums) {
  settling_.watch(sums, {state_.elapsed_s(), progress_.samples_left(sums), progress_.until_limit_s(),
                         static_cast<std::int64_t>(state_.plan.tiles_x() * state_.plan.tiles_y())});
}

// Or not any more. A profile that the user asked for goes on.
void Rank::record(const Locked&, bool wanted) {
  constexpr std::uint64_t turns = 16;
  std::optional<Profiling>& profiling = state_.work.profiling;
  if (!options_.outputs.profile.empty() || profiling.has_value() == wanted) return;
  profiling.reset();
  if (wanted) profiling.emplace(state_.scene.manifest.domains.size(), turns);
}

void Rank::watch_for_stall(const RoundSums& sums) {
  if (!stall_.seen(sums, state_.elapsed_s()) || transport_.rank() != 0) return;
  say("vitrail: no rank has had work for {} s (--patience), while {} rays are alive: messages do not arrive; "
      "the job ends; the same command continues from its last checkpoint\n",
      options_.resources.patience_s, sums.born - sums.died);
  constexpr int machine_failed = 4;
  transport_.abandon(machine_failed);
}

// The same on every rank, since the sums are.
Rank::Decision Rank::decide(const Round& round) {
  const RoundSums& sums = round.sums;
  if (phases_.any_done(sums)) checkpointing_.has_gained();
  checkpointing_.rays_are_alive(sums.born - sums.died);
  if (sums.pause > 0) checkpointing_.pause_begins();
  if (sums.bad_input + sums.machine_failure > 0) leave_failed(sums);
  auto quiet = Scheduler::Decision::go_on;
  {
    const Locked locked(state_);
    state_.scheduler.ranks_told(std::make_shared<const std::vector<RankReport>>(round.ranks));
    quiet = state_.scheduler.decide(sums);
    record(locked, sums.profiles > 0);
  }
  state_.work_available.notify_all();
  const bool settles = sums.settles > 1 || (sums.settles > 0 && quiet == Scheduler::Decision::all_quiet);
  if (settles && sums.pause == 0 && stop_of(sums) == Ending::none) return Decision::settle;
  exchange_.give_items();
  if (quiet == Scheduler::Decision::go_on || phases_.begin_next(sums)) return Decision::go_on;
  return ending_of(sums) == Ending::none ? Decision::pause : Decision::end;
}

std::optional<Ending> Rank::act_on(Decision decision, const RoundSums& sums) {
  if (decision == Decision::settle) {
    settling_.is_over();
    return Ending::none;
  }
  if (decision == Decision::pause) {
    checkpointing_.write_checkpoint();
    return std::nullopt;
  }
  Ending ending = ending_of(sums);
  if (ending == Ending::finished && goal_.in_rounds) {
    const std::optional<Ending> end = begin_next_round(stop_of(sums));
    if (!end) return std::nullopt;
    ending = *end;
  }
  if (options_.outputs.dry_run)
    in_parts(state_.film.counts(), state_.film.scratch().get(),
             [&](auto part) { transport_.sum_to_root(part); });
  else
    checkpointing_.write_last(/*as_film=*/writes_film(ending));
  progress_.finish();
  return ending;
}

Ending Rank::ending_of(const RoundSums& sums) const {
  return phases_.all_done(sums) ? Ending::finished : stop_of(sums);
}

// All items of a round are done and no ray is alive. Returns how the render ends: with the last round, or
// with `stop` where that is one; empty if another round has begun.
std::optional<Ending> Rank::begin_next_round(Ending stop) {
  checkpointing_.gather();
  std::optional<NextRound> next;
  agree(transport_, [&] {
    if (transport_.rank() == 0) next = next_round(state_.film, goal_);
  });
  auto plan = agree_on_round(transport_, std::move(next), state_.film, state_.plan);
  if (!plan) return Ending::finished;
  if (stop != Ending::none) return stop;
  if (transport_.rank() == 0) progress_.expect(expected_samples(state_.film, goal_));
  phases_.begin_round(std::move(*plan));
  return std::nullopt;
}

// Here or elsewhere. No rank may end while a message to it or from it is under way: messages sent and
// received are counted until the sums agree.
void Rank::leave_failed(const RoundSums& failures) {
  {
    const Locked locked(state_);
    state_.finished = true;
  }
  state_.work_available.notify_all();
  for (bool all_arrived = false; !all_arrived;) {
    RoundSums mine;
    mine.born = static_cast<std::int64_t>(exchange_.messages());
    mine.died = static_cast<std::int64_t>(exchange_.received());
    transport_.start_round(mine, {});
    std::optional<Round> round;
    while (!(round = transport_.finish_round())) {
      transport_.goes_on();
      exchange_.drop_arrivals();
      std::this_thread::sleep_for(Nap::shortest);
    }
    all_arrived = round->sums.born == round->sums.died;
  }
  std::exception_ptr own;
  {
    const Locked locked(state_);
    own = state_.failure;
  }
  leave(own, failures);
}

void Rank::add_to(RenderStats& stats) const {
  stats.traced = state_.work.counters;
  stats.load_s = state_.work.load_s;
  stats.trace_s = state_.work.trace_s;
  stats.idle_s = state_.work.idle_s;
  if (stats.settled.domains > 0) stats.settled.trace_s += stats.trace_s;
  stats.forwarded_rays = state_.scheduler.forwarded_rays();
  stats.forwarded_bytes = exchange_.sent_bytes();
  stats.messages = exchange_.messages();
  stats.items_given = state_.scheduler.items_given();
  stats.spilled_bytes = state_.queues.written_bytes() + state_.outgoing.written_bytes();
  stats.domain_loads = state_.scheduler.residency().loads();
  stats.evictions = state_.scheduler.residency().evictions();
  checkpointing_.add_to(stats);
  stats.tiles_read = state_.scene.textures.tile_loads();
  if (state_.photons) {
    stats.spilled_bytes += state_.photons->written_bytes();
    stats.photons_landed = state_.photons->landed;
    stats.photons_kept = state_.photons->most_kept;
  }
}

}  // namespace vitrail
