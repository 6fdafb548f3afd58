// SPDX-License-Identifier: Apache-2.0
// The simulation runs over any scheduler, watch, spill and way to receive, so that tests can put broken ones
// in their place: ranks (simulated_rank.h) in a world that they share (simulated_world.h), to which one event
// after the other happens. After each the job looks for what may never happen (invariants.h).
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "farm/scheduler/spill.h"
#include "farm/scheduler/stall.h"
#include "farm/simulator/simulated_rank.h"
#include "farm/simulator/simulated_rounds.h"

namespace vitrail {

// A rank receives a message whose head has come in one of two ways: it goes on meanwhile, or waits for the
// rest.
struct ReceivesBeside {
  static constexpr bool waits = false;
};

template <class SchedulerType, class WatchType = Watch, class SpillType = Spill,
          class ReceiveType = ReceivesBeside>
class SimulatedJob {
 public:
  SimulatedJob(const Workload& workload, const Machine& machine, const Mishaps& mishaps, std::uint64_t seed)
      : world_(workload, machine, mishaps, seed),
        rounds_(machine.ranks),
        stall_(machine.patience_s),
        waiting_(static_cast<std::size_t>(machine.ranks)),
        kept_(mishaps.kept) {
    const Homes homes = machine.homes ? *machine.homes : homes_by_bytes(workload.manifest, machine.ranks);
    const auto ranks = static_cast<std::uint64_t>(machine.ranks);
    ranks_.reserve(ranks);
    for (std::uint64_t rank = 0; rank < ranks; ++rank) {
      const auto share = [&](std::uint64_t all) { return all / ranks + (rank < all % ranks); };
      Rank& r = ranks_.emplace_back(world_, static_cast<int>(rank), homes);
      r.items = share(workload.items);
      r.rounds_of_samples = mishaps.kept.rounds;
      r.scheduler.begin_items(share(workload.items - mishaps.kept.items));
    }
    for (const Silence& s : mishaps.silences) ranks_[static_cast<std::size_t>(s.rank)].silence = s;
    ranks_[0].items_before = mishaps.kept.items;
    world_.result.kept = mishaps.kept;
  }
  SimulatedJob(const SimulatedJob&) = delete;
  SimulatedJob& operator=(const SimulatedJob&) = delete;

  // It is called once.
  SimulationResult run() {
    try {
      start();
      while (ended_ < ranks_.size() && world_.result.silent.empty() && !world_.result.stalled) take_event();
      return conclude();
    } catch (const InvariantBroken& what) {
      throw InvariantBroken(fmt::format("at {:.6f} s, event {}: {}", world_.machine.now_s(),
                                        world_.result.events, what.what()));
    }
  }

 private:
  using Event = SimulationEvent;
  using Rank = SimulatedRank<SchedulerType, WatchType, SpillType>;

  void start() {
    for (int i = 0; i < world_.mishaps.checkpoints; ++i) {
      const int rank = world_.machine.pick_rank();
      world_.events.at(-world_.mishaps.checkpoint_mean_s * std::log1p(-world_.machine.uniform()),
                       {Event::Kind::checkpoint, rank});
    }
    for (Rank& r : ranks_) {
      world_.events.at(0, {Event::Kind::round_begins, r.number()});
      r.wake_workers();
    }
  }

  void take_event() {
    if (world_.events.empty()) invariant::broken("nothing will ever happen again: a deadlock");
    const Event e = world_.events.pop();
    world_.machine.set_clock(e.time);
    ++world_.result.events;
    Rank& r = ranks_[static_cast<std::size_t>(e.rank)];
    if (r.silence.from_s <= e.time && e.time < r.silence.to_s) {
      if (std::isfinite(r.silence.to_s)) world_.events.at(r.silence.to_s, e);
      return;
    }
    if (ReceiveType::waits && waits(e)) return;
    happen(r, e);
    r.check();
    check_progress(e);
  }

  // Returns whether the rank is inside a receive: all that comes for it waits too.
  bool waits(const Event& e) {
    Waiting& w = waiting_[static_cast<std::size_t>(e.rank)];
    if (!w.message) {
      if (e.kind == Event::Kind::head) w.message = e.number;
      return false;
    }
    if (e.kind == Event::Kind::wants_rest) return false;  // MPI sends while it waits
    if (e.kind != Event::Kind::message || e.number != *w.message) {
      w.events.push_back(e);
      return true;
    }
    w.message.reset();
    for (const Event& held : std::exchange(w.events, {})) world_.events.at(e.time, held);
    return false;
  }

  void happen(Rank& r, const Event& e) {
    switch (e.kind) {
      case Event::Kind::task_done:
        r.finish_task(e.number);
        note_thirds();
        r.wake_workers();
        return r.wants_to_send();
      case Event::Kind::load_done:
        return r.finish_load(static_cast<std::uint32_t>(e.number));
      case Event::Kind::message:
        return r.message_came(world_.messages.extract(e.number).mapped());
      case Event::Kind::head:
        return r.ask_for_rest(e.number);
      case Event::Kind::wants_rest:
        return r.send_rest(e.number);
      case Event::Kind::look:
        return r.look();
      case Event::Kind::items:
        return r.take_items(e.number);
      case Event::Kind::round_begins:
        return begin_round(r);
      case Event::Kind::round_ends:
        return end_round(r);
      case Event::Kind::watch:
        return r.watch.look_after_others();
      case Event::Kind::ask:
        return r.watch.asked(static_cast<int>(e.number));
      case Event::Kind::answer:
        return r.watch.answered(static_cast<int>(e.number));
      case Event::Kind::checkpoint:
        r.wants_checkpoint = !r.ended;
        return;
    }
  }

  // A message, a load or a task always leads to another event; only rounds can go on for ever.
  void check_progress(const Event& e) {
    if (e.kind <= Event::Kind::wants_rest) ++progress_;
    if (e.kind != Event::Kind::round_ends || e.rank != 0) return;
    rounds_without_progress_ = progress_ == progress_then_ ? rounds_without_progress_ + 1 : 0;
    progress_then_ = progress_;
    if (rounds_without_progress_ > 10'000)
      invariant::broken("10,000 rounds without any other event: no progress");
  }

  // --- Rounds
  void begin_round(Rank& r) {
    r.joins_round();
    RoundSums mine = r.scheduler.contribution();
    mine.items_done += static_cast<std::int64_t>(r.items_before);
    mine.pause = r.wants_checkpoint;
    mine.machine_failure = r.failed;
    mine.working = r.is_working();
    r.watch.round_begins();
    if (!rounds_.join(r.round, r.number(), mine, r.scheduler.report())) return;
    ++world_.result.rounds;
    for (const Rank& other : ranks_)
      world_.events.at(world_.machine.now_s() + world_.machine.round_s(),
                       {Event::Kind::round_ends, other.number()});
  }

  void end_round(Rank& r) {
    const auto [sums, reports] = rounds_.leave(r.round);
    r.scheduler.ranks_told(reports);
    ++r.round;
    r.watch.round_ends();
    if (sums.machine_failure > 0) {
      world_.result.failed = true;
      ++failed_[r.round];
      return end(r);
    }
    if (r.scheduler.decide(sums) != Scheduler::Decision::all_quiet) {
      if (r.number() == 0) world_.result.stalled = stall_.seen(sums, world_.machine.now_s());
      r.give_items();
    } else if (!goes_on_after_quiet(r, sums))
      return end(r);
    r.wake_workers();
    world_.events.at(world_.machine.now_s() + world_.machine.costs().round_interval_s * world_.machine.late(),
                     {Event::Kind::round_begins, r.number()});
  }

  // All leave together, with a disk that failed or a film that is gathered from all.
  void end(Rank& r) {
    r.ended = true;
    ++ended_;
    r.watch.round_begins();
  }

  // Returns false where all is done.
  bool goes_on_after_quiet(Rank& r, const RoundSums& sums) {
    if (quiet_round_ != r.round) note_kept(r, sums);
    quiet_round_ = r.round;
    r.check_queues();
    // A checkpoint is written when all ranks have given their part of it.
    if (++quiet_[r.round] == ranks_.size() && sums.pause > 0) world_.result.kept = kept_;
    if (sums.items_done == static_cast<std::int64_t>(world_.workload.items)) {
      if (++r.rounds_of_samples == world_.mishaps.rounds_of_samples) return false;
      r.items_before = 0;
      r.scheduler.begin_items(r.items);
      return true;
    }
    if (sums.pause == 0) invariant::broken("all is quiet, not done, and nobody asked for a pause");
    world_.result.checkpoints += r.number() == 0;
    r.wants_checkpoint = false;
    r.scheduler.resume();
    return true;
  }

  // The first rank that finds that all is quiet notes what a checkpoint would hold now. No item is open; all
  // rays of those dealt were generated.
  void note_kept(const Rank& first, const RoundSums& sums) {
    if (world_.alive != 0)
      invariant::broken(
          fmt::format("rank {} thinks that it is over with {} rays alive", first.number(), world_.alive));
    for (const Rank& r : ranks_)
      if (r.has_open_item()) invariant::broken("all is quiet with an item that is open");
    kept_ = {first.rounds_of_samples, static_cast<std::uint64_t>(sums.items_done)};
    check_generated(kept_);
  }
  void check_generated(const KeptWork& now) const {
    invariant::check_generated(world_.generated, world_.mishaps.kept, now, world_.workload);
  }

  // --- The end
  SimulationResult conclude() {
    world_.result.seconds = world_.machine.now_s();
    for (const int rank : world_.result.silent)
      invariant::check_silent(rank, ranks_[static_cast<std::size_t>(rank)].silence, world_.mishaps,
                              world_.machine);
    if (!world_.result.silent.empty()) return world_.result;
    if (world_.result.stalled) {
      if (!world_.mishaps.lost_message || *world_.mishaps.lost_message >= world_.result.messages)
        invariant::broken("nothing was lost, and it was given up as if something were");
      return world_.result;
    }
    if (world_.result.failed) {
      invariant::check_agreement(failed_, ranks_.size(), "ended because of a disk");
      return world_.result;
    }
    if (world_.alive != 0) invariant::broken(fmt::format("the job ended with {} rays alive", world_.alive));
    check_generated({world_.mishaps.rounds_of_samples, 0});
    invariant::check_agreement(quiet_, ranks_.size(), "thought that all was quiet");
    Moment all = moment();
    if (thirds_.size() == 2) lengthen(all, thirds_[0], thirds_[1], world_.workload.middle_again);
    all.sums.around_s = world_.machine.costs().setup_s + world_.machine.reduction_s();
    all.sums.seconds += all.sums.around_s;
    add_shares(all, world_.machine.costs());
    return all.sums;
  }

  // Notes the moments when one third and two thirds of the items are dealt.
  void note_thirds() {
    const Workload& w = world_.workload;
    if (w.middle_again == 0 || thirds_.size() == 2) return;
    if (3 * world_.generated >= (thirds_.size() + 1) * w.items * w.rays_an_item) thirds_.push_back(moment());
  }
  Moment moment() const {
    Moment now{world_.result, {}, world_.machine.busiest_link_s()};
    now.sums.seconds = world_.machine.now_s();
    for (const Rank& r : ranks_) {
      now.ranks.push_back(r.busy());
      now.sums.busy_s += r.busy().working_s;
      now.sums.most_bytes += r.most_bytes();
      now.sums.loads += r.scheduler.residency().loads();
      now.sums.evictions += r.scheduler.residency().evictions();
      now.sums.forwarded_rays += r.scheduler.forwarded_rays();
      now.sums.given_items += r.scheduler.items_given();
    }
    return now;
  }

  SimulatedWorld world_;
  std::vector<Rank> ranks_;
  SimulatedRounds rounds_;
  Stall stall_;
  struct Waiting {
    std::optional<std::uint64_t> message;
    std::vector<Event> events;
  };
  std::vector<Waiting> waiting_;  // by rank
  std::size_t ended_ = 0;         // ranks
  std::uint64_t progress_ = 0, progress_then_ = 0, rounds_without_progress_ = 0;
  KeptWork kept_;                                // what a checkpoint holds that is being written
  std::optional<std::uint64_t> quiet_round_;     // the last that found that all was quiet
  std::map<std::uint64_t, std::size_t> quiet_;   // ranks that found so, by round
  std::map<std::uint64_t, std::size_t> failed_;  // ranks that ended because of a disk, by round
  std::vector<Moment> thirds_;
};

}  // namespace vitrail
