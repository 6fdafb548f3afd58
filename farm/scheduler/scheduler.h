// SPDX-License-Identifier: Apache-2.0
// Everything that one rank decides: what a worker does next, which domain is loaded and which leaves, when
// rays are sent, how many may be born, when the job pauses and when it is over. Events in, actions out: no
// thread, clock, message or file is in it, so that the farm and the simulator run the same code. Seconds are
// of the caller's clock.
#pragma once

#include <memory>
#include <random>
#include <unordered_map>
#include <vector>

#include "farm/scheduler/residency.h"
#include "farm/scheduler/round.h"

namespace vitrail {

class Scheduler {
 public:
  struct Job {
    int ranks = 1;
    int workers = 1;                // of this rank
    std::int64_t rays_allowed = 0;  // alive in the whole job; as many as there are ranks at least
    int rank = 0;                   // this one
  };
  Scheduler(const Job& job, Residency residency);

  // --- Workers. A task is a batch of the rays that wait for a domain, or some rays of the item that is open
  // or next. An item that was begun is finished before the job pauses.
  enum class Work { none, trace, generate };
  struct Task {
    Work work = Work::none;
    std::uint32_t domain = 0;
    std::uint64_t rays = 0;  // to generate, at most
  };
  Task next_task() const;
  void begin_batch(std::uint32_t domain, std::uint64_t rays);
  // From now on these many items are the rank's; of those before, all are done, everywhere.
  void begin_items(std::uint64_t items);
  // Items that another rank is to have, of those that no worker has begun. On their way they count as rays
  // do that are alive, so that nothing ends or pauses meanwhile.
  struct Gift {
    int to = 0;
    std::uint64_t items = 0;
  };
  std::vector<Gift> give_items();
  void items_arrived(std::uint64_t items);
  // Generates `rays` of item items_dealt(), its last ones if it `ends` with them.
  void begin_rays(std::uint64_t rays, bool ends);
  // What a task made, or a part of it, is counted in one step with where it waits, so that no round misses a
  // ray that is alive.
  void count(std::uint64_t born, std::uint64_t died);
  void finish_task(std::uint64_t generated);  // what begin_rays was told, 0 after a batch
  void worker_waits() { ++workers_waiting_; }
  void worker_wakes() { --workers_waiting_; }
  int workers_waiting() const { return workers_waiting_; }
  bool all_workers_wait() const { return workers_waiting_ == job_.workers; }

  // --- Rays. `true`: they wait here, else for being sent to the domain's home.
  bool route(std::uint32_t domain, std::uint64_t rays);
  // What is no ray of a domain's, but is sent and counted as alive like one.
  void goes_out(std::uint64_t records) { outgoing_ += records, forwarded_ += records; }
  // They came from another rank, which may have known homes of before.
  bool arrived(std::uint32_t domain, std::uint64_t rays) { return route(domain, rays); }
  bool send_is_due(double now_s) const;
  // Where rays that are sent go: of two of the domain's homes the one where fewer wait, as far as is known.
  // It may be this rank.
  int destination(std::uint32_t domain, std::uint64_t rays);
  void sent(std::uint64_t rays, double now_s);
  std::uint64_t rays_to_send() const { return outgoing_; }

  // --- Domains.
  LoadStep loader_is_free() { return residency_.loader_is_free(alive_, workers_waiting_ == job_.workers); }
  void loaded(std::uint32_t domain) { residency_.loaded(domain); }
  void released(std::uint64_t bytes) { residency_.released(bytes); }
  const Residency& residency() const { return residency_; }

  // --- Rounds. `ranks_told`: what each rank told when it joined the round that ended. Of many ranks that is
  // a long list, which those that are simulated share.
  void ranks_told(std::shared_ptr<const std::vector<RankReport>> by_rank);
  // Whoever asks for a pause or an end adds it to the contribution.
  RoundSums contribution();
  RankReport report() const;
  enum class Decision { go_on, all_quiet };
  // The same on every rank, since the sums are. `all_quiet`: no ray is alive and none will be born, until
  // `resume` where the job was paused.
  Decision decide(const RoundSums& sums);
  void resume() { calm_ = false; }
  // While no worker lives the domains get other `homes`. First `leaving` counts the rays that wait here and
  // are to be sent then: all where this rank is no home of the domain, else all but an even share. `leave`
  // tells that they wait for being sent. When they do `settle` changes the homes; `domain_bytes` are as at
  // the start, and as many rays as before may be alive. It returns the domains that leave the memory. Rays
  // that were on their way to a home of before are sent on from there.
  std::uint64_t leaving(std::uint32_t domain, const Homes& homes) const;
  void leave(std::uint32_t domain, std::uint64_t rays);
  LoadStep settle(Homes homes, std::uint64_t domain_bytes);

  std::uint64_t items_dealt() const { return next_item_; }  // to the last ray
  std::uint64_t items_given() const { return given_; }
  std::uint64_t forwarded_rays() const { return forwarded_; }

 private:
  bool is_full() const;
  std::uint64_t even_share() const { return static_cast<std::uint64_t>(job_.rays_allowed / job_.ranks + 1); }
  bool wants_to_generate() const { return item_is_open_ || (!paused_ && next_item_ < items_); }
  // None where each domain has one home: whoever generates its rays, the same rank traces them. And a rank
  // whose workers wait keeps its own: it waits for leave to generate, and would else get back what it has
  // just given.
  std::uint64_t spare_items() const {
    return (residency_.all_are_local() || homes_overlap_) && workers_waiting_ == 0
               ? items_ - next_item_ - item_is_open_
               : 0;
  }
  bool is_idle() const { return next_item_ == items_ && workers_waiting_ > 0; }

  Job job_;
  Residency residency_;
  bool homes_overlap_;  // some domain has several
  std::uint64_t items_ = 0, next_item_ = 0, given_ = 0;
  bool item_is_open_ = false;                             // some of its rays are generated, some not
  std::uint64_t in_hand_ = 0;                             // tasks that generate
  std::uint64_t rays_in_hand_ = 0;                        // that these generate
  std::uint64_t born_ = 0, died_ = 0;                     // rays, here
  std::uint64_t alive_ = 0;                               // in the whole job, at the last round
  std::uint64_t allowance_ = 0;                           // rays that may be generated
  std::uint64_t waiting_ = 0;                             // rays that wait to be traced here
  std::uint64_t outgoing_ = 0, forwarded_ = 0;            // rays
  std::shared_ptr<const std::vector<RankReport>> ranks_;  // at the last round; null: none yet
  std::int64_t idle_ranks_ = 0;                           // of them
  std::unordered_map<int, std::int64_t> sent_there_;      // rays, since then
  std::minstd_rand pair_;                                 // which two homes are compared next
  double last_sent_s_ = 0;
  int workers_waiting_ = 0;
  bool asked_ = false;  // for leave to generate, in the round that it has joined
  bool paused_ = false;
  bool calm_ = false;  // the last round saw no ray alive and nothing to generate
  std::int64_t born_then_ = -1;
};

}  // namespace vitrail
