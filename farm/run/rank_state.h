// SPDX-License-Identifier: Apache-2.0
// A RankState holds what the threads of a rank share, under one mutex that is held for moments; tracing runs
// outside it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>

#include "farm/files/timeline.h"
#include "farm/plan/job_plan.h"
#include "farm/plan/work.h"
#include "farm/rays/queues.h"
#include "farm/run/photon_work.h"
#include "farm/run/profiling.h"
#include "farm/run/resident_domains.h"
#include "farm/scheduler/scheduler.h"
#include "tracer/transport/waves/tracer.h"

namespace vitrail {

// It holds the items that are this rank's, of the phase at hand.
struct ItemShare {
  std::vector<std::uint64_t> items;  // that are not dealt, the next one last
  std::uint64_t at = 0;              // samples of the open item that are dealt
};

// It counts what the rank has traced so far, and where its time went.
struct RankWork {
  TraceCounters counters;
  std::optional<Profiling> profiling;  // empty: nothing is recorded
  std::optional<Timeline> timeline;    // the same
  double trace_s = 0;                  // of the processor; the others are of the clock
  double idle_s = 0, load_s = 0;
};

// Its `mutex` guards all of it but the film, the scene and `begun`: functions that want it held take a
// Locked.
struct RankState {
  using Clock = std::chrono::steady_clock;
  RankState(const RenderScene& scene, Film& film, WorkPlan work, const JobPlan& plan,
            const RenderOptions& options);

  const RenderScene& scene;
  Film& film;
  WorkPlan plan;  // of this round; changes while no item is in hand
  const Clock::time_point begun = Clock::now();

  std::mutex mutex;
  std::condition_variable work_available, load_wanted;
  Scheduler scheduler;
  RayQueues queues;    // of local domains
  RayQueues outgoing;  // of the others' domains
  ResidentDomains domains;
  ItemShare share;
  // They are bits of the items dealt that rank 0 does not hold yet; all of them on rank 0. The items are done
  // when no ray is alive.
  std::vector<std::uint64_t> done;
  std::optional<PhotonWork> photons;  // while they fly, the share is of their chunks
  RankWork work;
  int loads_under_way = 0;
  bool a_loader_looks = false;  // again and again, while the other loaders wait for a notice
  bool finished = false;
  std::exception_ptr failure;

  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - begun).count(); }
  bool photons_fly() const { return photons && photons->flying(); }
};

// It proves that a rank's mutex is held.
class Locked {
 public:
  explicit Locked(RankState& state) : lock_(state.mutex) {}
  // Runs something meanwhile without the mutex.
  template <class F>
  void without(const F& something) {
    lock_.unlock();
    something();
    lock_.lock();
  }
  void wait(std::condition_variable& of) { of.wait(lock_); }
  void wait(std::condition_variable& of, std::chrono::milliseconds at_most) { of.wait_for(lock_, at_most); }

 private:
  std::unique_lock<std::mutex> lock_;
};

// Adds to the timeline, where one is recorded, what the thread that moves rays has done since `begin`.
void note(RankState& state, Timeline::Kind kind, RankState::Clock::time_point begin,
          const Timeline::Values& values = {});

// Notes the exception of a thread that failed; the first counts.
void fail(RankState& state, std::exception_ptr why);

}  // namespace vitrail
