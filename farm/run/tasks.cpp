// SPDX-License-Identifier: Apache-2.0
#include "farm/run/tasks.h"

#include <algorithm>

namespace vitrail {

namespace {

// Photons of the chunk that is open or next.
void take_photons(const Locked&, RankState& s, std::uint64_t most, Task& task) {
  const std::uint64_t chunk = s.share.items.back(), all = s.photons->photons_in(chunk);
  const std::uint64_t first = s.share.at, end = std::min(all, first + most);
  s.share.at = end == all ? 0 : end;
  task.photons = true;
  task.first = chunk * PhotonWork::chunk_photons + first;
  task.end = chunk * PhotonWork::chunk_photons + end;
  s.scheduler.begin_rays(end - first, end == all);
  if (end == all) s.share.items.pop_back();
}

// That it is begun to its end.
void close_item(RankState& s) {
  const std::uint64_t item = s.share.items.back();
  s.share.items.pop_back();
  s.done[item / 64] |= std::uint64_t{1} << (item % 64);
}

// Samples of the item that is open or next; of a whole one, those of the items that go on with its pixels
// too, so that the samples of a pixel are traced side by side.
void take_samples(const Locked&, RankState& s, std::uint64_t most, Task& task) {
  constexpr std::uint64_t most_together = 4 * Wave::most;
  constexpr std::size_t left_to_others = 64;  // items, so that threads end together
  task.item = s.plan.item(s.share.items.back());
  const std::uint64_t samples = s.plan.samples(task.item);
  task.first = s.share.at;
  task.end = std::min(samples, s.share.at + most);
  s.share.at = task.end == samples ? 0 : task.end;
  std::uint64_t closed = 0;
  if (task.end == samples) {
    close_item(s), ++closed;
    while (task.first == 0 && s.share.items.size() > left_to_others) {
      const WorkItem next = s.plan.item(s.share.items.back());
      const std::uint64_t together = task.end + s.plan.samples(next);
      if (together > std::min(most, most_together) || !goes_on_with(s.plan, task.item, next)) break;
      task.item.sample1 = next.sample1;
      task.end = together;
      close_item(s), ++closed;
    }
  }
  s.scheduler.begin_rays(task.end - task.first, closed > 0);
  for (; closed > 1; --closed) s.scheduler.begin_rays(0, true);
}

// Where tasks take turns they are a wave each, so that neighbours in the picture are traced in all manners.
constexpr std::uint64_t samples_of_a_turn = Wave::most;

}  // namespace

Task take_task(const Locked& locked, RankState& s) {
  Task task;
  task.table = s.domains.table();
  if (s.photons && !s.photons->questions.empty()) {
    task.work = Scheduler::Work::trace;
    task.batch = s.photons->questions.pop();
    return task;
  }
  const Scheduler::Task next = s.scheduler.next_task();
  task.work = next.work;
  if (next.work == Scheduler::Work::trace) {
    task.batch = s.queues.pop(next.domain);
    s.scheduler.begin_batch(next.domain, task.batch.count());
  } else if (next.work == Scheduler::Work::generate) {
    const std::uint64_t most = s.work.profiling ? std::min(next.rays, samples_of_a_turn) : next.rays;
    (s.photons_fly() ? take_photons : take_samples)(locked, s, most, task);
  }
  return task;
}

}  // namespace vitrail
