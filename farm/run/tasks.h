// SPDX-License-Identifier: Apache-2.0
// A Task is what a worker takes in hand: rays that wait for a domain, or samples and photons to begin.
#pragma once

#include <cstdint>
#include <memory>

#include "farm/run/rank_state.h"

namespace vitrail {

// A Task holds a batch of waiting rays, or a work item.
struct Task {
  Scheduler::Work work = Scheduler::Work::none;
  RayBatch batch;
  WorkItem item;
  std::uint64_t first = 0, end = 0;  // samples of the item, or photons by number
  bool photons = false;
  std::shared_ptr<const ResidentTable> table;
};

// Returns what the scheduler decides; an empty task where there is nothing to do now.
Task take_task(const Locked& locked, RankState& state);

// Gives the task's rays to the tracer, and calls `traced` after each. Rays that wait in the tracer are traced
// in the end.
template <class Traced>
void perform(Task& task, const WorkPlan& plan, Tracer& tracer, const Traced& traced) {
  if (task.photons) {
    for (std::uint64_t i = task.first; i < task.end; ++i) {
      tracer.trace_photon(static_cast<std::uint32_t>(i));
      traced();
    }
    return;
  }
  if (task.work == Scheduler::Work::generate) {
    for_each_sample(plan, task.item, task.first, task.end, [&](int x, int y, std::uint32_t sample) {
      tracer.trace_camera(x, y, sample);
      traced();
    });
    return;
  }
  RayBatch& batch = task.batch;
  const auto resume_all = [&](const auto& records) {
    for (const auto& record : records) {
      tracer.resume(record, batch.domain());
      traced();
    }
  };
  if (batch.kind() == RayKind::path)
    resume_all(batch.records<RayRecord>());
  else if (batch.kind() == RayKind::question)
    for (const Gather& question : batch.records<Gather>()) {
      tracer.answer(question);
      traced();
    }
  else
    resume_all(batch.records<ShadowRecord>());
}

}  // namespace vitrail
