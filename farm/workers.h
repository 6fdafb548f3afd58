// SPDX-License-Identifier: Apache-2.0
// The threads of a rank: workers that generate and trace rays, some that load domains. They share the rank's
// state under one mutex that is held for moments; tracing runs outside it.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "farm/photon_work.h"
#include "farm/queues.h"
#include "farm/resident_domains.h"
#include "farm/scheduler/scheduler.h"
#include "farm/timeline.h"
#include "farm/work.h"
#include "tracer/path_tracer.h"

namespace vitrail {

// Everything the threads of a rank share. `mutex` guards all of it but the film and the scene.
struct RankState {
  RankState(const RenderScene& scene, Film& film, WorkPlan plan, RayQueues queues, RayQueues outgoing,
            Scheduler scheduler, const std::filesystem::path& bundle);

  const RenderScene& scene;
  Film& film;
  WorkPlan plan;  // of this round; changes while no item is in hand

  std::mutex mutex;
  std::condition_variable work_available, load_wanted;
  Scheduler scheduler;
  RayQueues queues;                   // of local domains
  RayQueues outgoing;                 // of the others' domains
  std::uint64_t most_sent_bytes = 0;  // that the transport holds; what is more stays in `outgoing`
  ResidentDomains domains;
  std::vector<std::uint64_t> share;  // items of this rank that are not dealt, the next one last
  std::uint64_t item_at = 0;         // samples of the open item that are dealt
  // Bits of the items dealt that rank 0 does not hold yet; all of them on rank 0. They are done when no ray
  // is alive.
  std::vector<std::uint64_t> done;
  std::optional<PhotonWork> photons;  // while they fly, the share is of their chunks
  bool finished = false;

  TraceCounters counters;
  std::optional<RayTraffic> traffic;  // empty: not recorded
  std::optional<Timeline> timeline;   // the same
  double trace_s = 0;                 // of the processor; the others are of the clock
  double idle_s = 0, load_s = 0;
  std::exception_ptr failure;
};

// Starts `threads` workers and the loaders; the destructor ends and joins them. Throws MachineError where the
// system makes no more threads.
class Workers {
 public:
  Workers(RankState& state, int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

 private:
  void end();

  RankState& state_;
  std::vector<std::jthread> threads_;
};

}  // namespace vitrail
