// SPDX-License-Identifier: Apache-2.0
// It is a rank of a simulated job: a scheduler, a watch and a spill, and simulated threads, memory and
// messages. Tests put broken ones, derived from the farm's own, in their place.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "farm/scheduler/scheduler.h"
#include "farm/simulator/invariants.h"
#include "farm/simulator/lengthen.h"
#include "farm/simulator/simulated_memory.h"
#include "farm/simulator/simulated_queues.h"
#include "farm/simulator/simulated_watch.h"
#include "farm/simulator/simulated_world.h"

namespace vitrail {

template <class SchedulerType, class WatchType, class SpillType>
class SimulatedRank {
 public:
  SimulatedRank(SimulatedWorld& world, int rank, const Homes& homes)
      : SimulatedRank(world, world.machine.costs(), rank, homes) {}

  // --- Workers
  void wake_workers() {
    for (std::size_t i = 0; i < workers_.size() && scheduler.workers_waiting() > 0; ++i)
      if (workers_[i].work == Work::none && !begin_task(i)) break;
    wake_loaders();
  }

  void finish_task(std::uint64_t worker) {
    Worker& w = workers_[static_cast<std::size_t>(worker)];
    for (const auto& [domain, rays] : w.rays.made) {
      rays_ += rays;
      if (scheduler.route(domain, rays))
        world_.result.spilled_rays += queues_.put(domain, rays);
      else
        outgoing_[domain] += rays;
    }
    note_most();
    scheduler.count(w.rays.born, w.rays.died);
    scheduler.finish_task(w.rays.generated);
    world_.generated += w.rays.generated;
    w.work = Work::none;
    scheduler.worker_waits();
    release();
  }

  // --- Domains
  void finish_load(std::uint32_t domain) {
    const DiskError& error = world_.mishaps.disk_error;
    if (number_ == error.rank && world_.machine.now_s() >= error.from_s) {
      failed = true;
      return;
    }
    memory_.finish_load(domain);
    scheduler.loaded(domain);
    invariant::check_table(number_, memory_, scheduler.residency());
    wake_workers();
  }

  // --- Messages. The thread that moves them naps; what comes, and what is to be sent, waits until it looks.
  void message_came(SimulatedMessage message) {
    came_.push_back(std::move(message));
    will_look();
  }
  void wants_to_send() {
    if (scheduler.rays_to_send() > 0) will_look();
  }
  void look() {
    will_look_ = false;
    move_messages();
  }
  void joins_round() {
    move_messages();
    moved_s_ = world_.machine.now_s();
  }

  // They move a message in two parts.
  void ask_for_rest(std::uint64_t message) {
    world_.send({SimulationEvent::Kind::wants_rest, world_.routes.at(message).from, message});
  }
  void send_rest(std::uint64_t message) {
    world_.send({SimulationEvent::Kind::message, world_.routes.extract(message).mapped().to, message});
  }

  void give_items() {
    for (const auto& [to, count] : scheduler.give_items())
      world_.send({SimulationEvent::Kind::items, to, count});
  }

  void take_items(std::uint64_t count) {
    if (ended && !world_.result.failed)
      invariant::broken(fmt::format("rank {} had ended when items came", number_));
    scheduler.items_arrived(count);
    wake_workers();
  }

  // --- What may never happen
  void check() const {
    invariant::check_bytes(number_, memory_, queues_.bytes_in_memory(), scheduler.residency(), costs());
  }
  void check_queues() const {
    for (std::uint32_t d = 0; d < queues_.domains(); ++d)
      invariant::check_queue(number_, d, queues_.rays(d), scheduler.residency());
  }

  int number() const { return number_; }
  bool is_working() const { return !scheduler.all_workers_wait() || !memory_.loads().empty(); }
  bool has_open_item() const { return item_at_ != 0; }
  const Busy& busy() const { return busy_; }
  std::uint64_t most_bytes() const { return memory_.most_bytes(); }

  SchedulerType scheduler;
  SimulatedWatch<WatchType> watch;
  Silence silence;
  bool ended = false, wants_checkpoint = false;
  bool failed = false;  // a load of its own
  std::uint64_t items = 0;
  std::uint64_t items_before = 0;  // on rank 0: of this round of samples, done by an earlier run
  int rounds_of_samples = 0;       // done
  std::uint64_t round = 0;         // which it joins next, or has joined

 private:
  using Work = Scheduler::Work;
  struct Worker {
    Work work = Work::none;
    TaskRays rays;
    std::uint64_t began = 0;  // load steps before it
  };

  SimulatedRank(SimulatedWorld& world, const Machine& costs, int rank, const Homes& homes)
      : scheduler({costs.ranks, costs.workers, costs.rays_allowed, rank},
                  Residency(world.workload.manifest, costs.domain_bytes, homes, rank, costs.distribution)),
        watch(world, rank),
        world_(world),
        number_(rank),
        memory_(world.workload.manifest, rank),
        queues_(world.workload.domains.size(), costs),
        workers_(static_cast<std::size_t>(costs.workers)) {
    for (std::size_t i = 0; i < workers_.size(); ++i) scheduler.worker_waits();
  }

  void will_look() {
    if (std::exchange(will_look_, true)) return;
    world_.events.at(world_.machine.next_look_s(moved_s_), {SimulationEvent::Kind::look, number_});
  }

  void move_messages() {
    const bool due = scheduler.send_is_due(world_.machine.now_s());
    if (!came_.empty() || due) moved_s_ = world_.machine.now_s();
    for (const SimulatedMessage& message : std::exchange(came_, {})) receive(message);
    if (due) send();
  }

  void send() {
    const double now_s = world_.machine.now_s();
    std::uint64_t sent = 0;
    std::map<int, SimulatedMessage> messages;  // by destination
    for (const auto& [domain, rays] : outgoing_) {
      sent += rays;
      for (std::uint64_t left = rays; left > 0;) {
        const std::uint64_t batch = std::min(left, costs().rays_of_a_batch);
        messages[scheduler.destination(domain, batch)].emplace_back(domain, batch);
        left -= batch;
      }
    }
    for (auto& [to, message] : messages) send(to, std::move(message));
    rays_ -= sent;
    outgoing_.clear();
    scheduler.sent(sent, now_s);
  }

  void receive(const SimulatedMessage& message) {
    // A rank that leaves because of another takes what comes until all have left.
    if (ended && world_.result.failed) return;
    for (const auto& [domain, rays] : message) {
      if (ended) invariant::broken(fmt::format("rank {} had ended when {} rays arrived", number_, rays));
      if (!scheduler.residency().homes().has(domain, number_))
        invariant::broken(fmt::format("rank {} got {} rays for a domain of another", number_, rays));
      world_.result.spilled_rays += queues_.put(domain, rays);
      rays_ += rays;
      scheduler.arrived(domain, rays);
    }
    note_most();
    wake_workers();
  }

  // Returns false where there is no task.
  bool begin_task(std::size_t worker) {
    Worker& w = workers_[worker];
    const auto task = scheduler.next_task();
    if (task.work == Work::none) return false;
    scheduler.worker_wakes();
    w.work = task.work;
    w.began = memory_.steps();
    w.rays = task.work == Work::trace ? trace(task.domain) : generate(task.rays);
    world_.count(w.rays);
    const double seconds =
        w.rays.seconds * (world_.machine.late() * (number_ == 0 ? world_.mishaps.slow_rank : 1));
    busy_.working_s += seconds;
    world_.events.at(world_.machine.now_s() + seconds, {SimulationEvent::Kind::task_done, number_, worker});
    return true;
  }

  TaskRays trace(std::uint32_t domain) {
    if (!memory_.resident().contains(domain))
      invariant::broken(fmt::format("rank {} traces in an absent domain", number_));
    invariant::check_queue(number_, domain, queues_.rays(domain), scheduler.residency());
    const std::uint64_t rays = std::min(queues_.rays(domain), costs().rays_of_a_batch);
    if (rays == 0) invariant::broken(fmt::format("rank {} traces where no ray waits", number_));
    const double disk_s = world_.machine.write_and_read_s(queues_.take(domain, rays));
    rays_ -= rays;
    scheduler.begin_batch(domain, rays);
    return world_.flow.trace(domain, rays, disk_s, memory_.resident(), world_.machine);
  }

  TaskRays generate(std::uint64_t most_rays) {
    const std::uint64_t of_an_item = world_.workload.rays_an_item;
    const std::uint64_t rays = std::min(of_an_item - item_at_, most_rays);
    if (rays == 0) invariant::broken(fmt::format("rank {} generates nothing", number_));
    item_at_ = (item_at_ + rays) % of_an_item;
    scheduler.begin_rays(rays, item_at_ == 0);
    return world_.flow.generate(rays, memory_.resident(), world_.machine);
  }

  void wake_loaders() {
    while (memory_.loads().size() < static_cast<std::size_t>(costs().loaders) && take_load_step()) {
    }
  }

  // Returns false where there is no step.
  bool take_load_step() {
    const LoadStep step = scheduler.loader_is_free();
    if (step.load) invariant::check_load(number_, memory_, *step.load, world_.workload.manifest);
    const std::uint64_t bytes = memory_.take(step);
    if (step.load) read(*step.load, bytes);
    release();
    if (!step.load && step.evicted.empty()) return false;
    invariant::check_table(number_, memory_, scheduler.residency());
    return true;
  }

  void read(const LoadStep::Load& load, std::uint64_t bytes) {
    const std::optional<PackPlace>& at = world_.workload.manifest.domains[load.domain].pack;
    const bool opens = !at || packs_.insert(at->pack).second;
    const double files = static_cast<double>(load.missing.size() + (opens ? 1 : 0));
    const double until_s = world_.machine.read(number_, files, bytes);
    busy_.loading_s += until_s - world_.machine.now_s();
    world_.result.loaded_bytes += bytes;
    world_.events.at(until_s, {SimulationEvent::Kind::load_done, number_, load.domain});
  }

  // Lets go of what workers hold that began before an eviction, when they are done.
  void release() {
    std::uint64_t oldest = memory_.steps() + 1;
    for (const Worker& w : workers_)
      if (w.work != Work::none) oldest = std::min(oldest, w.began);
    scheduler.released(memory_.release(oldest));
  }

  void send(int to, SimulatedMessage message) {
    std::uint64_t rays = 0;
    for (const auto& [domain, batch] : message) rays += batch;
    const std::uint64_t number = world_.result.messages++;
    world_.messages.emplace(number, std::move(message));
    const double arrives_s = world_.machine.arrival_s(number_, to, rays);
    if (number == world_.mishaps.lost_message) return;
    if (world_.mishaps.in_two_parts) world_.routes.emplace(number, SimulatedWorld::Route{number_, to});
    world_.events.at(arrives_s, {world_.mishaps.in_two_parts ? SimulationEvent::Kind::head
                                                             : SimulationEvent::Kind::message,
                                 to, number});
  }

  void note_most() { world_.result.most_on_a_rank = std::max(world_.result.most_on_a_rank, rays_); }
  const Machine& costs() const { return world_.machine.costs(); }

  SimulatedWorld& world_;
  int number_;
  SimulatedMemory memory_;
  SimulatedQueues<SpillType> queues_;
  std::map<std::uint32_t, std::uint64_t> outgoing_;  // rays, by domain
  std::vector<Worker> workers_;
  std::set<std::uint32_t> packs_;       // that it has opened
  std::vector<SimulatedMessage> came_;  // since the rank looked
  bool will_look_ = false;
  double moved_s_ = 0;         // when messages moved last, or a round began
  std::uint64_t rays_ = 0;     // that wait here, or for being sent
  std::uint64_t item_at_ = 0;  // rays of the open item that are generated
  Busy busy_;
};

}  // namespace vitrail
