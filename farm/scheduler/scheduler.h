// SPDX-License-Identifier: Apache-2.0
// The Scheduler decides everything for one rank: what a worker does next, which domain is loaded and which
// leaves, when rays are sent, how many may be born, when the job pauses and when it is over. It takes events
// and returns actions: no thread, clock, message or file is in it, so the farm and the simulator run the same
// code. Seconds are of the caller's clock.
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
  // Gives the rank so many items. All that it had before are done, on every rank.
  void begin_items(std::uint64_t items);
  // A Gift says which rank gets how many of the items that no worker has begun. On their way items count as
  // rays that are alive, so that nothing ends or pauses meanwhile.
  struct Gift {
    int to = 0;
    std::uint64_t items = 0;
  };
  std::vector<Gift> give_items();
  void items_arrived(std::uint64_t items);
  // Begins to generate `rays` of item items_dealt(); they are its last ones where it `ends` with them.
  void begin_rays(std::uint64_t rays, bool ends);
  // Counts the rays that a task, or a part of it, made and ended. The caller routes them in the same step, so
  // that no round misses a ray that is alive.
  void count(std::uint64_t born, std::uint64_t died);
  void finish_task(std::uint64_t generated);  // what begin_rays was told, 0 after a batch
  void worker_waits() { ++workers_waiting_; }
  void worker_wakes() { --workers_waiting_; }
  int workers_waiting() const { return workers_waiting_; }
  bool all_workers_wait() const { return workers_waiting_ == job_.workers; }

  // --- Rays. Returns whether they wait here; if not, they wait for being sent to the domain's home.
  bool route(std::uint32_t domain, std::uint64_t rays);
  // Counts records that are no rays of a domain, but are sent and count as alive like rays.
  void goes_out(std::uint64_t records) { outgoing_ += records, forwarded_ += records; }
  // Does the same for rays of another rank, which may have sent them to a home of before.
  bool arrived(std::uint32_t domain, std::uint64_t rays) { return route(domain, rays); }
  bool send_is_due(double now_s) const;
  // Returns the rank that rays are sent to: of two of the domain's homes the one where fewer wait, as far as
  // is known. It may be this rank.
  int destination(std::uint32_t domain, std::uint64_t rays);
  void sent(std::uint64_t rays, double now_s);
  std::uint64_t rays_to_send() const { return outgoing_; }

  // --- Domains.
  LoadStep loader_is_free() { return residency_.loader_is_free(alive_, workers_waiting_ == job_.workers); }
  void loaded(std::uint32_t domain) { residency_.loaded(domain); }
  void released(std::uint64_t bytes) { residency_.released(bytes); }
  const Residency& residency() const { return residency_; }

  // --- Rounds. Takes what each rank told when it joined the round that ended. For many ranks that is a long
  // list, which simulated ranks share.
  void ranks_told(std::shared_ptr<const std::vector<RankReport>> by_rank);
  // Returns what this rank adds to the sums. Whoever asks for a pause or an end adds that to it.
  RoundSums contribution();
  RankReport report() const;
  enum class Decision { go_on, all_quiet };
  // Decides the same on every rank, since the sums are the same. `all_quiet` says that no ray is alive and
  // that none will be born, until `resume` where the job was paused.
  Decision decide(const RoundSums& sums);
  void resume() { calm_ = false; }
  // The domains get other `homes` in three steps, while no worker lives. `leaving` returns the rays that wait
  // here and are to be sent: all where this rank is no home of the domain, else all but an even share.
  // `leave` counts such rays as waiting for being sent. `settle` then changes the homes and returns the
  // domains that leave the memory; `domain_bytes` are as at the start, and as many rays as before may be
  // alive. Rays that are on their way to a home of before are sent on from there.
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
  // Returns none where each domain has one home: whoever generates its rays, the same rank traces them. A
  // rank whose workers wait keeps its items: it waits for leave to generate, and would else get back what it
  // has just given.
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
