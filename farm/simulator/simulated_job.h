// SPDX-License-Identifier: Apache-2.0
// The simulation itself, over any scheduler, watch and spill, so that tests can put broken ones in their
// place.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <utility>

#include "bundle/loaded_domain.h"
#include "farm/scheduler/scheduler.h"
#include "farm/scheduler/spill.h"
#include "farm/scheduler/watch.h"
#include "farm/simulator/event.h"
#include "farm/simulator/lengthen.h"
#include "farm/simulator/simulation.h"

namespace vitrail {

template <class SchedulerType, class WatchType = Watch, class SpillType = Spill>
class SimulatedJob {
 public:
  SimulatedJob(const Workload& workload, const Machine& machine, const Mishaps& mishaps, std::uint64_t seed)
      : workload_(workload),
        machine_(machine),
        mishaps_(mishaps),
        random_(seed),
        disks_(static_cast<std::size_t>((machine.ranks - 1) / machine.ranks_of_a_disk + 1)),
        standing_(workload.domains.size()) {
    const auto add_up = [&](const Workload::Domain& from) {
      std::vector<double>& until = until_.emplace_back();
      for (const Workload::Way& way : from.ways)
        until.push_back((until.empty() ? 0 : until.back()) + way.rays);
    };
    for (const Workload::Domain& d : workload.domains) add_up(d);
    add_up(workload.camera);
    const Homes homes = machine.homes ? *machine.homes : homes_by_bytes(workload.manifest, machine.ranks);
    for (int r = 0; r < machine.ranks; ++r) {
      const auto ranks = static_cast<std::uint64_t>(machine.ranks), rank = static_cast<std::uint64_t>(r);
      const auto share = [&](std::uint64_t all) { return all / ranks + (rank < all % ranks); };
      ranks_.emplace_back(
          SchedulerType({machine.ranks, machine.workers, machine.rays_allowed, r},
                        Residency(workload.manifest, machine.domain_bytes, homes, r, machine.distribution)),
          WatchType(r, machine.ranks, machine.patience_s),
          SpillType(workload.domains.size(), machine.queue_bytes), workload.domains.size(),
          static_cast<std::size_t>(machine.workers));
      ranks_.back().items = share(workload.items);
      ranks_.back().rounds_of_samples = mishaps.kept.rounds;
      ranks_.back().scheduler.begin_items(share(workload.items - mishaps.kept.items));
    }
    for (const Silence& s : mishaps.silences) ranks_[static_cast<std::size_t>(s.rank)].silence = s;
    ranks_[0].items_before = mishaps.kept.items;
    result_.kept = kept_ = mishaps.kept;
    for (int i = 0; i < mishaps.checkpoints; ++i)
      at(-mishaps.checkpoint_mean_s * std::log1p(-uniform()), {Event::Kind::checkpoint, pick_rank()});
    for (int r = 0; r < machine.ranks; ++r) {
      at(0, {Event::Kind::round_begins, r});
      wake_workers(r);
    }
  }

  SimulationResult run() {
    // A message, a load or a task always leads to another event; only rounds can go on for ever.
    std::uint64_t rounds_without_progress = 0, progress = 0;
    while (ended_ < ranks_.size()) {
      if (events_.empty()) broken("nothing will ever happen again: a deadlock");
      const Event e = events_.top();
      events_.pop();
      now_ = e.time;
      ++result_.events;
      const Silence& silence = ranks_[static_cast<std::size_t>(e.rank)].silence;
      if (silence.from_s <= now_ && now_ < silence.to_s) {
        if (std::isfinite(silence.to_s)) at(silence.to_s, e);
        continue;
      }
      happen(e);
      check(e.rank);
      if (!result_.silent.empty()) {
        check_silent();
        result_.seconds = now_;
        return result_;
      }
      if (e.kind <= Event::Kind::message) ++progress;
      if (e.kind == Event::Kind::round_ends && e.rank == 0) {
        rounds_without_progress = progress == progress_then_ ? rounds_without_progress + 1 : 0;
        progress_then_ = progress;
        if (rounds_without_progress > 10'000) broken("10,000 rounds without any other event: no progress");
      }
    }
    if (result_.failed) {
      for (const auto& [round, ranks] : failed_)
        if (ranks != ranks_.size())
          broken(fmt::format("in round {} only {} ranks ended because of a disk", round, ranks));
      result_.seconds = now_;
      return result_;
    }
    if (alive_ != 0) broken(fmt::format("the job ended with {} rays alive", alive_));
    check_generated({mishaps_.rounds_of_samples, 0});
    for (const auto& [round, ranks] : quiet_)
      if (ranks != ranks_.size())
        broken(fmt::format("in round {} only {} ranks thought that all was quiet", round, ranks));
    return whole_job();
  }

 private:
  using Event = SimulationEvent;
  using Message = std::vector<std::pair<std::uint32_t, std::uint64_t>>;  // batches: domain, rays
  struct Worker {
    typename SchedulerType::Work work = SchedulerType::Work::none;
    std::map<std::uint32_t, std::uint64_t> made;  // rays by domain, when it is done
    std::uint64_t generated = 0, born = 0, died = 0;
    std::uint64_t began = 0;  // evictions before it
  };
  // What left the table and workers still hold.
  struct Evicted {
    std::uint64_t number = 0;  // of the eviction
    std::uint64_t bytes = 0;
  };
  struct Rank {
    Rank(SchedulerType s, WatchType w, SpillType p, std::size_t domains, std::size_t threads)
        : scheduler(std::move(s)),
          watch(std::move(w)),
          spill(std::move(p)),
          queues(domains),
          in_memory(domains),
          workers(threads) {
      for (std::size_t i = 0; i < threads; ++i) scheduler.worker_waits();
    }
    SchedulerType scheduler;
    WatchType watch;
    Silence silence;
    bool watch_is_due = false;  // the event is on its way
    SpillType spill;
    std::vector<std::uint64_t> queues;     // rays, by domain
    std::vector<std::uint64_t> in_memory;  // of these, the others are on the disk
    std::uint64_t bytes_in_memory = 0;     // of rays
    std::map<std::uint32_t, std::uint64_t> outgoing;
    std::vector<Worker> workers;
    std::uint64_t rays = 0;         // that wait here
    std::uint64_t item_at = 0;      // rays of the open item that are generated
    std::set<std::uint32_t> table;  // resident domains
    std::vector<Evicted> evicted;
    std::uint64_t evictions = 0, bytes = 0;                     // bytes mapped or reserved
    std::map<std::uint32_t, std::vector<std::uint32_t>> loads;  // under way: objects that they bring
    bool ended = false, wants_checkpoint = false;
    bool failed = false;  // a load of its own
    std::uint64_t items = 0;
    std::uint64_t items_before = 0;  // on rank 0: of this round of samples, done by an earlier run
    int rounds_of_samples = 0;       // done
    Busy busy;
    std::uint64_t most_bytes = 0;
    std::uint64_t round = 0;
    double sending_until = 0;
  };
  // A third, and two, of the items are dealt.
  void note_thirds() {
    const std::uint64_t all = workload_.items * workload_.rays_an_item;
    if (workload_.middle_again > 0 && thirds_.size() < 2 && 3 * generated_ >= (thirds_.size() + 1) * all)
      thirds_.push_back(moment());
  }
  Moment moment() const {
    Moment now{result_, {}};
    now.sums.seconds = now_;
    for (const Rank& r : ranks_) {
      now.ranks.push_back(r.busy);
      now.sums.busy_s += r.busy.working_s;
      now.sums.most_bytes += r.most_bytes;
      now.sums.loads += r.scheduler.residency().loads();
      now.sums.evictions += r.scheduler.residency().evictions();
      now.sums.forwarded_rays += r.scheduler.forwarded_rays();
      now.sums.given_items += r.scheduler.items_given();
    }
    return now;
  }
  SimulationResult whole_job() const {
    Moment end = moment();
    if (thirds_.size() == 2) lengthen(end, thirds_[0], thirds_[1], workload_.middle_again);
    SimulationResult& all = end.sums;
    const double worker_s = all.seconds * static_cast<double>(machine_.workers);
    for (const Busy& rank : end.ranks) {
      all.busiest_workers = std::max(all.busiest_workers, rank.working_s / worker_s);
      all.busiest_loader = std::max(all.busiest_loader, rank.loading_s / all.seconds / machine_.loaders);
      all.busiest_link = std::max(all.busiest_link, rank.sending_s / all.seconds);
    }
    all.efficiency = all.busy_s / (worker_s * static_cast<double>(ranks_.size()));
    return all;
  }

  struct OpenRound {
    int joined = 0, left = 0;
    RoundSums sums;
    std::shared_ptr<std::vector<RankReport>> reports;
  };

  [[noreturn]] void broken(const std::string& what) const {
    throw InvariantBroken(fmt::format("at {:.6f} s, event {}: {}", now_, result_.events, what));
  }
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  int pick_rank() { return static_cast<int>(random_() % ranks_.size()); }
  double late() { return 1 + machine_.jitter * uniform(); }
  void at(double time, Event e) {
    e.time = time;
    e.order = next_order_++;
    events_.push(e);
  }
  std::uint64_t rounded(double rays) {
    const double whole = std::floor(rays);
    return static_cast<std::uint64_t>(whole) + (uniform() < rays - whole);
  }

  void happen(const Event& e) {
    Rank& r = ranks_[static_cast<std::size_t>(e.rank)];
    switch (e.kind) {
      case Event::Kind::task_done:
        return finish_task(e.rank, r.workers[static_cast<std::size_t>(e.number)]);
      case Event::Kind::load_done:
        return finish_load(e.rank, static_cast<std::uint32_t>(e.number));
      case Event::Kind::message:
        return receive(e.rank, messages_.extract(e.number).mapped());
      case Event::Kind::items:
        return take_items(e.rank, e.number);
      case Event::Kind::round_begins:
        return begin_round(e.rank);
      case Event::Kind::round_ends:
        return end_round(e.rank);
      case Event::Kind::watch:
        r.watch_is_due = false;
        return look_after_others(e.rank);
      case Event::Kind::ask:
        r.watch.asked(now_);
        return at(now_ + late() * machine_.latency_s,
                  {Event::Kind::answer, static_cast<int>(e.number), static_cast<std::uint64_t>(e.rank)});
      case Event::Kind::answer:
        return r.watch.answered(static_cast<int>(e.number));
      case Event::Kind::checkpoint:
        r.wants_checkpoint = !r.ended;
        return;
    }
  }

  // --- workers
  void wake_workers(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    for (std::size_t i = 0; i < r.workers.size() && r.scheduler.workers_waiting() > 0; ++i)
      if (r.workers[i].work == SchedulerType::Work::none && !begin_task(rank, i)) break;
    wake_loaders(rank);
  }

  bool begin_task(int rank, std::size_t number) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    Worker& w = r.workers[number];
    const auto task = r.scheduler.next_task();
    if (task.work == SchedulerType::Work::none) return false;
    r.scheduler.worker_wakes();
    w.work = task.work;
    w.began = r.evictions;
    w.generated = w.born = w.died = 0;
    double seconds = 0;
    if (task.work == SchedulerType::Work::trace) {
      if (!r.table.contains(task.domain)) broken(fmt::format("rank {} traces in an absent domain", rank));
      check_queue(rank, task.domain);
      const std::uint64_t rays = std::min(r.queues[task.domain], machine_.rays_of_a_batch);
      if (rays == 0) broken(fmt::format("rank {} traces where no ray waits", rank));
      const std::uint64_t from_disk = take_from_queue(r, task.domain, rays);
      seconds = 2 * static_cast<double>(from_disk * machine_.bytes_a_ray) / machine_.scratch_bytes_s;
      r.rays -= rays;
      r.scheduler.begin_batch(task.domain, rays);
      go_to(task.domain, rays);
    } else {
      w.generated = std::min<std::uint64_t>(workload_.rays_an_item - r.item_at, task.rays);
      if (w.generated == 0) broken(fmt::format("rank {} generates nothing", rank));
      r.item_at = (r.item_at + w.generated) % workload_.rays_an_item;
      r.scheduler.begin_rays(w.generated, r.item_at == 0);
      w.born = w.generated;
      alive_ += w.born;
      result_.most_alive = std::max(result_.most_alive, alive_);
      std::uint64_t left = w.born;
      go_on(w.generated, workload_.camera, until_.back(), [&](std::uint32_t domain, std::uint64_t rays) {
        rays = std::min(left, rays);
        go_to(domain, rays);
        left -= rays;
      });
      // The others meet nothing.
      alive_ -= left;
      w.died += left;
    }
    seconds += 1e-6 + workload_.camera.seconds * static_cast<double>(w.generated);
    w.made.clear();
    // Domains that rays stand in, the first that was entered first.
    for (std::size_t i = 0; i < entered_.size(); ++i) {
      const std::uint32_t domain = entered_[i];
      const std::uint64_t rays = std::exchange(standing_[domain], 0);
      if (!r.table.contains(domain)) {
        w.made[domain] += rays;
        continue;
      }
      const Workload::Domain& d = workload_.domains[domain];
      seconds += d.seconds * static_cast<double>(rays);
      result_.rays += rays;
      w.died += rays;
      go_on(rays, d, until_[domain], [&](std::uint32_t to, std::uint64_t leave) {
        go_to(to, leave);
        w.born += leave;
        alive_ += leave;
      });
      alive_ -= rays;
    }
    entered_.clear();
    seconds *= late() * (rank == 0 ? mishaps_.slow_rank : 1);
    r.busy.working_s += seconds;
    at(now_ + seconds, {Event::Kind::task_done, rank, number});
    return true;
  }

  // Where those go on to that come of `rays`: few each by a way of its own, many by all ways at once.
  template <class Leave>
  void go_on(std::uint64_t rays, const Workload::Domain& from, const std::vector<double>& until,
             const Leave& leave) {
    const std::vector<Workload::Way>& ways = from.ways;
    if (ways.empty()) return;
    const double all = until.back() * static_cast<double>(rays);
    if (all >= static_cast<double>(ways.size())) {
      for (const Workload::Way& way : ways) leave(way.domain, rounded(way.rays * static_cast<double>(rays)));
      return;
    }
    for (std::uint64_t left = rounded(all); left > 0; --left) {
      const auto way = std::ranges::upper_bound(until, uniform() * until.back()) - until.begin();
      leave(ways[std::min(static_cast<std::size_t>(way), ways.size() - 1)].domain, 1);
    }
  }

  void go_to(std::uint32_t domain, std::uint64_t rays) {
    if (rays == 0) return;
    if (standing_[domain] == 0) entered_.push_back(domain);
    standing_[domain] += rays;
  }

  void finish_task(int rank, Worker& w) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    for (const auto& [domain, rays] : w.made) {
      r.rays += rays;
      if (r.scheduler.route(domain, rays))
        put_in_queue(r, domain, rays);
      else
        r.outgoing[domain] += rays;
    }
    result_.most_on_a_rank = std::max(result_.most_on_a_rank, r.rays);
    r.scheduler.count(w.born, w.died);
    r.scheduler.finish_task(w.generated);
    generated_ += w.generated;
    note_thirds();
    w.work = SchedulerType::Work::none;
    r.scheduler.worker_waits();
    release(r);
    send(rank);
    wake_workers(rank);
  }

  // --- domains
  void wake_loaders(int rank) {
    const Rank& r = ranks_[static_cast<std::size_t>(rank)];
    while (r.loads.size() < static_cast<std::size_t>(machine_.loaders) && take_load_step(rank)) {
    }
  }

  // False: there is none.
  bool take_load_step(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    const LoadStep step = r.scheduler.loader_is_free();
    if (step.load) check_objects(rank, *step.load);
    ++r.evictions;
    for (const std::uint32_t domain : step.evicted) {
      if (!r.table.contains(domain)) broken(fmt::format("rank {} evicts an absent domain", rank));
      r.table.erase(domain);
    }
    const std::uint64_t reserved = step.load ? begin_load(rank, *step.load) : 0;
    if (!step.evicted.empty()) {
      // What no resident domain and no load needs any more leaves memory with the last worker that began
      // before.
      const std::uint64_t kept = bytes_of(with_loads(r));
      std::uint64_t leaving = 0;
      for (const Evicted& e : r.evicted) leaving += e.bytes;
      if (r.bytes + reserved < kept + leaving) broken("bytes are miscounted");
      const std::uint64_t bytes = r.bytes + reserved - kept - leaving;
      r.evicted.push_back({r.evictions, bytes});
    }
    r.bytes += reserved;
    r.most_bytes = std::max(r.most_bytes, r.bytes);
    release(r);
    if (step.load || !step.evicted.empty()) check_table(rank);
    return step.load || !step.evicted.empty();
  }

  // The bytes that it brings.
  std::uint64_t begin_load(int rank, const LoadStep::Load& load) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    if (r.table.contains(load.domain) || r.loads.contains(load.domain))
      broken(fmt::format("rank {} loads domain {} twice", rank, load.domain));
    std::uint64_t bytes = bytes_loaded(workload_.manifest, load.domain);
    for (const std::uint32_t o : load.missing) bytes += workload_.manifest.objects[o].bytes;
    r.loads.emplace(load.domain, load.missing);
    const double files = 1 + static_cast<double>(load.missing.size());
    const double slow = late();
    double& read_until = disks_[static_cast<std::size_t>(rank / machine_.ranks_of_a_disk)];
    read_until = std::max(read_until, now_ + slow * files * machine_.disk_latency_s) +
                 slow * static_cast<double>(bytes) / machine_.disk_bytes_s;
    r.busy.loading_s += read_until - now_;
    result_.loaded_bytes += bytes;
    at(read_until, {Event::Kind::load_done, rank, load.domain});
    return bytes;
  }

  // Resident domains and those under way.
  static std::set<std::uint32_t> with_loads(const Rank& r) {
    std::set<std::uint32_t> domains = r.table;
    for (const auto& [domain, objects] : r.loads) domains.insert(domain);
    return domains;
  }

  // With their objects, each counted once.
  std::uint64_t bytes_of(const std::set<std::uint32_t>& domains) const {
    std::vector<bool> counted(workload_.manifest.objects.size());
    std::uint64_t bytes = 0;
    for (const std::uint32_t domain : domains) {
      bytes += bytes_loaded(workload_.manifest, domain);
      for (const std::uint32_t o : workload_.manifest.domains[domain].objects)
        if (!counted[o]) {
          counted[o] = true;
          bytes += workload_.manifest.objects[o].bytes;
        }
    }
    return bytes;
  }

  // What workers that began before an eviction hold is let go when they are done.
  void release(Rank& r) {
    std::uint64_t oldest = r.evictions + 1;
    for (const Worker& w : r.workers)
      if (w.work != SchedulerType::Work::none) oldest = std::min(oldest, w.began);
    std::erase_if(r.evicted, [&](const Evicted& e) {
      if (e.number > oldest) return false;
      r.bytes -= e.bytes;
      r.scheduler.released(e.bytes);
      return true;
    });
  }

  void finish_load(int rank, std::uint32_t domain) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    if (rank == mishaps_.disk_error.rank && now_ >= mishaps_.disk_error.from_s) {
      r.failed = true;
      return;
    }
    r.loads.erase(domain);
    r.table.insert(domain);
    r.scheduler.loaded(domain);
    check_table(rank);
    wake_workers(rank);
  }

  // --- messages
  void send(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    if (!r.scheduler.send_is_due(now_)) return;
    std::uint64_t sent = 0;
    std::map<int, Message> messages;  // by destination
    for (const auto& [domain, rays] : r.outgoing) {
      sent += rays;
      for (std::uint64_t left = rays; left > 0;) {
        const std::uint64_t batch = std::min(left, machine_.rays_of_a_batch);
        messages[r.scheduler.destination(domain, batch)].emplace_back(domain, batch);
        left -= batch;
      }
    }
    for (auto& [to, message] : messages) {
      std::uint64_t rays = 0;
      for (const auto& [domain, batch] : message) rays += batch;
      const double seconds = static_cast<double>(rays * machine_.bytes_a_ray) / machine_.network_bytes_s;
      r.sending_until = std::max(r.sending_until, now_) + seconds;
      r.busy.sending_s += seconds;
      const std::uint64_t number = result_.messages++;
      messages_.emplace(number, std::move(message));
      at(r.sending_until + late() * machine_.latency_s, {Event::Kind::message, to, number});
    }
    r.rays -= sent;
    r.outgoing.clear();
    r.scheduler.sent(sent, now_);
  }

  void give_items(Rank& r) {
    for (const auto& [to, items] : r.scheduler.give_items())
      at(now_ + late() * machine_.latency_s, {Event::Kind::items, to, items});
  }
  void take_items(int rank, std::uint64_t items) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    if (r.ended && !result_.failed) broken(fmt::format("rank {} had ended when items came", rank));
    r.scheduler.items_arrived(items);
    wake_workers(rank);
  }

  void receive(int rank, const Message& message) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    // A rank that leaves because of another takes what comes until all have left.
    if (r.ended && result_.failed) return;
    for (const auto& [domain, rays] : message) {
      if (r.ended) broken(fmt::format("rank {} had ended when {} rays arrived", rank, rays));
      if (!r.scheduler.residency().homes().has(domain, rank))
        broken(fmt::format("rank {} got {} rays for a domain of another", rank, rays));
      put_in_queue(r, domain, rays);
      r.rays += rays;
      r.scheduler.arrived(domain, rays);
    }
    result_.most_on_a_rank = std::max(result_.most_on_a_rank, r.rays);
    wake_workers(rank);
  }

  // --- queues
  void put_in_queue(Rank& r, std::uint32_t domain, std::uint64_t rays) {
    r.queues[domain] += rays;
    hold(r, domain, static_cast<std::int64_t>(rays));
    while (const auto full = r.spill.next()) {
      const std::uint64_t written = std::min(r.in_memory[*full], machine_.rays_of_a_batch);
      if (written == 0) broken(fmt::format("no ray in memory waits for domain {}", *full));
      result_.spilled_rays += written;
      hold(r, *full, -static_cast<std::int64_t>(written));
    }
  }
  // Those in memory first; gives how many the others are.
  std::uint64_t take_from_queue(Rank& r, std::uint32_t domain, std::uint64_t rays) {
    r.queues[domain] -= rays;
    const std::uint64_t held = std::min(rays, r.in_memory[domain]);
    hold(r, domain, -static_cast<std::int64_t>(held));
    return rays - held;
  }
  void hold(Rank& r, std::uint32_t domain, std::int64_t rays) {
    const auto bytes = static_cast<std::uint64_t>(std::abs(rays)) * machine_.bytes_a_ray;
    rays > 0 ? r.spill.added(domain, bytes) : r.spill.removed(domain, bytes);
    r.in_memory[domain] += static_cast<std::uint64_t>(rays);
    r.bytes_in_memory += static_cast<std::uint64_t>(rays) * machine_.bytes_a_ray;
  }

  // --- rounds
  void begin_round(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    send(rank);
    RoundSums mine = r.scheduler.contribution();
    mine.items_done += static_cast<std::int64_t>(r.items_before);
    mine.pause = r.wants_checkpoint;
    mine.machine_failure = r.failed;
    r.watch.round_begins(now_);
    expect_watch(rank);
    OpenRound& round = rounds_[r.round];
    add(round.sums, mine);
    if (!round.reports) round.reports = std::make_shared<std::vector<RankReport>>(ranks_.size());
    (*round.reports)[static_cast<std::size_t>(rank)] = r.scheduler.report();
    if (++round.joined < machine_.ranks) return;
    ++result_.rounds;
    const double steps = std::bit_width(static_cast<unsigned>(machine_.ranks));
    for (int other = 0; other < machine_.ranks; ++other)
      at(now_ + late() * machine_.latency_s * steps, {Event::Kind::round_ends, other});
  }

  void end_round(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    OpenRound& round = rounds_.at(r.round);
    const RoundSums sums = round.sums;
    r.scheduler.ranks_told(round.reports);
    if (++round.left == machine_.ranks) rounds_.erase(r.round);
    ++r.round;
    r.watch.round_ends();
    if (sums.machine_failure > 0) {
      result_.failed = r.ended = true;
      ++failed_[r.round];
      ++ended_;
      // They leave together.
      r.watch.round_begins(now_);
      return expect_watch(rank);
    }
    if (r.scheduler.decide(sums) == SchedulerType::Decision::all_quiet) {
      if (!over_ || *over_ != r.round) {
        if (alive_ != 0)
          broken(fmt::format("rank {} thinks that it is over with {} rays alive", rank, alive_));
        over_ = r.round;
        note_kept(r, sums);
      }
      for (std::uint32_t d = 0; d < r.queues.size(); ++d) check_queue(rank, d);
      // Written when all ranks have given what they have of it.
      if (++quiet_[r.round] == ranks_.size() && sums.pause > 0) result_.kept = kept_;
      if (sums.items_done == static_cast<std::int64_t>(workload_.items)) {
        if (++r.rounds_of_samples == mishaps_.rounds_of_samples) {
          r.ended = true;
          ++ended_;
          // The film is gathered from all together.
          r.watch.round_begins(now_);
          return expect_watch(rank);
        }
        r.items_before = 0;
        r.scheduler.begin_items(r.items);
      } else {
        if (sums.pause == 0) broken("all is quiet, not done, and nobody asked for a pause");
        result_.checkpoints += rank == 0;
        r.wants_checkpoint = false;
        r.scheduler.resume();
      }
    } else {
      give_items(r);
    }
    wake_workers(rank);
    at(now_ + machine_.round_interval_s * late(), {Event::Kind::round_begins, rank});
  }

  static void add(RoundSums& to, const RoundSums& from) {
    to.born += from.born;
    to.reserved += from.reserved;
    to.wanting += from.wanting;
    to.full += from.full;
    to.died += from.died;
    to.quiet += from.quiet;
    to.idle += from.idle;
    to.machine_failure += from.machine_failure;
    to.pause += from.pause;
    to.items_done += from.items_done;
  }

  // --- ranks that do not answer
  void expect_watch(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    if (r.watch_is_due || !std::isfinite(r.watch.due_s())) return;
    r.watch_is_due = true;
    at(std::max(now_, r.watch.due_s()), {Event::Kind::watch, rank});
  }

  void look_after_others(int rank) {
    Rank& r = ranks_[static_cast<std::size_t>(rank)];
    const auto step = r.watch.step(now_);
    if (step == WatchType::Step::ask_all)
      for (int other = 0; other < machine_.ranks; ++other)
        if (other != rank)
          at(now_ + late() * machine_.latency_s, {Event::Kind::ask, other, static_cast<std::uint64_t>(rank)});
    // The launcher ends all ranks then.
    if (step == WatchType::Step::give_up) result_.silent = r.watch.silent();
    expect_watch(rank);
  }

  // --- what may never happen
  // Those that are named did not answer for long enough, and none was waited for longer than promised.
  void check_silent() const {
    const double longest_way_s = machine_.latency_s * (1 + machine_.jitter);
    for (const int rank : result_.silent) {
      double all_awake_s = 0;  // but for the dead
      for (const Silence& s : mishaps_.silences)
        all_awake_s = std::max(all_awake_s, std::isfinite(s.to_s) ? s.to_s : s.from_s);
      const Silence& s = ranks_[static_cast<std::size_t>(rank)].silence;
      if (s.from_s > now_ || s.to_s - s.from_s < machine_.patience_s / 2 - 2 * longest_way_s)
        broken(fmt::format("rank {} is well and was given up", rank));
      if (now_ > all_awake_s + 3 * machine_.patience_s + machine_.round_interval_s * (1 + machine_.jitter) +
                     32 * longest_way_s)
        broken(fmt::format("rank {} was silent since {} s", rank, s.from_s));
    }
  }

  // All is quiet: what a checkpoint would hold now. No item is open; of those dealt all rays were generated.
  void note_kept(const Rank& one, const RoundSums& sums) {
    for (const Rank& r : ranks_)
      if (r.item_at != 0) broken("all is quiet with an item that is open");
    kept_ = {one.rounds_of_samples, static_cast<std::uint64_t>(sums.items_done)};
    check_generated(kept_);
  }
  void check_generated(const KeptWork& now) const {
    const auto items = [&](const KeptWork& w) {
      return static_cast<std::uint64_t>(w.rounds) * workload_.items + w.items;
    };
    if (generated_ != (items(now) - items(mishaps_.kept)) * workload_.rays_an_item)
      broken(fmt::format("{} camera rays were generated for {} items of {}", generated_,
                         items(now) - items(mishaps_.kept), workload_.rays_an_item));
  }

  void check(int rank) const {
    const Rank& r = ranks_[static_cast<std::size_t>(rank)];
    const Residency& residency = r.scheduler.residency();
    if (r.bytes != residency.held_bytes())
      broken(fmt::format("rank {} holds {} bytes and counts {}", rank, r.bytes, residency.held_bytes()));
    if (r.bytes_in_memory > machine_.queue_bytes)
      broken(
          fmt::format("rank {} holds {} bytes of rays of {}", rank, r.bytes_in_memory, machine_.queue_bytes));
    if (r.bytes > machine_.domain_bytes)
      broken(fmt::format("rank {} holds {} bytes of {}", rank, r.bytes, machine_.domain_bytes));
  }
  // What a load does not bring is in memory, and not on its way; what leaves for it may have it.
  void check_objects(int rank, const LoadStep::Load& load) const {
    const Rank& r = ranks_[static_cast<std::size_t>(rank)];
    std::set<std::uint32_t> there;
    for (const std::uint32_t domain : with_loads(r))
      for (const std::uint32_t object : workload_.manifest.domains[domain].objects) there.insert(object);
    for (const auto& [domain, objects] : r.loads)
      for (const std::uint32_t object : objects) there.erase(object);
    there.insert(load.missing.begin(), load.missing.end());
    for (const std::uint32_t object : workload_.manifest.domains[load.domain].objects)
      if (!there.contains(object))
        broken(fmt::format("rank {} loads domain {} without object {}", rank, load.domain, object));
  }
  void check_table(int rank) const {
    const Rank& r = ranks_[static_cast<std::size_t>(rank)];
    const std::uint64_t bytes = bytes_of(with_loads(r)), counted = r.scheduler.residency().table_bytes();
    if (bytes != counted)
      broken(fmt::format("rank {} has {} bytes in its table and counts {}", rank, bytes, counted));
  }
  void check_queue(int rank, std::uint32_t domain) const {
    const Rank& r = ranks_[static_cast<std::size_t>(rank)];
    const std::uint64_t counted = r.scheduler.residency().waiting(domain);
    if (r.queues[domain] != counted)
      broken(fmt::format("{} rays wait for domain {} on rank {}, which counts {}", r.queues[domain], domain,
                         rank, counted));
  }

  const Workload& workload_;
  const Machine machine_;
  const Mishaps mishaps_;
  std::mt19937_64 random_;
  std::vector<double> disks_;  // until when each reads
  std::vector<Rank> ranks_;
  std::vector<std::vector<double>> until_;  // sums of the ways' rays, by domain, the camera's last
  std::vector<std::uint64_t> standing_;     // rays of the task that is worked out, by domain
  std::vector<std::uint32_t> entered_;      // domains of these
  std::map<std::uint64_t, OpenRound> rounds_;
  std::map<std::uint64_t, Message> messages_;  // under way, by number
  std::priority_queue<Event> events_;
  std::uint64_t next_order_ = 0, progress_then_ = 0;
  double now_ = 0;
  std::uint64_t alive_ = 0, generated_ = 0;
  std::size_t ended_ = 0;
  KeptWork kept_;                                // what a checkpoint holds that is being written
  std::map<std::uint64_t, std::size_t> quiet_;   // ranks that thought so, by round
  std::optional<std::uint64_t> over_;            // the round that said so
  std::map<std::uint64_t, std::size_t> failed_;  // ranks that ended because of a disk, by round
  std::vector<Moment> thirds_;
  SimulationResult result_;
};

}  // namespace vitrail
