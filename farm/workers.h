// SPDX-License-Identifier: Apache-2.0
// The threads of a rank: workers that generate and trace rays, one that loads domains. They share the rank's
// state under one mutex that is held for moments; tracing runs outside it.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "farm/queues.h"
#include "farm/residency.h"
#include "farm/work.h"
#include "tracer/path_tracer.h"

namespace vitrail {

// Everything the threads of a rank share. `mutex` guards all of it but the film and the scene.
struct RankState {
  RankState(const RenderScene& scene, Film& film, WorkPlan plan, RayQueues queues, Residency residency);

  const RenderScene& scene;
  Film& film;
  WorkPlan plan;  // of this round; changes while no item is in hand

  std::mutex mutex;
  std::condition_variable work_available, load_wanted;
  RayQueues queues;  // of local domains
  Residency residency;
  RayQueues outgoing;  // of the others' domains
  std::size_t outgoing_rays = 0;

  std::vector<std::uint64_t> share;  // items of this rank
  std::size_t next_item = 0;         // index into `share`
  std::size_t items_in_hand = 0;     // taken and not yet published
  std::int64_t allowance = 0;        // rays that may be generated before the next round
  std::size_t alive = 0;             // rays in the whole job, at the last round
  bool paused = false, finished = false;

  TraceCounters counters;
  std::vector<std::uint64_t> visits;  // rays traced in each domain; empty: not counted
  std::uint64_t forwarded_rays = 0;
  int workers_waiting = 0, workers = 0;
  double trace_s = 0, idle_s = 0, load_s = 0;
  std::exception_ptr failure;

  bool quiet() const { return items_in_hand == 0 && (paused || next_item == share.size()); }
};

// Starts `threads` workers and the loader; the destructor ends and joins them.
class Workers {
 public:
  Workers(RankState& state, int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

 private:
  RankState& state_;
  std::vector<std::jthread> threads_;
};

}  // namespace vitrail
