// SPDX-License-Identifier: Apache-2.0
#include "farm/workers.h"

#include <chrono>
#include <optional>

namespace vitrail {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// With this many rays waiting for a resident domain no new ones are generated.
constexpr std::size_t rays_worth_tracing_first = 4096;

// What a worker does next: a batch of waiting rays, or a work item.
struct Task {
  std::optional<RayBatch> batch;
  std::optional<WorkItem> item;
  std::uint64_t item_index = 0;
  std::shared_ptr<const ResidentTable> table;
};

std::optional<std::uint32_t> fullest_resident(const RankState& s) {
  std::optional<std::uint32_t> best;
  std::size_t most = 0;
  const auto& views = s.residency.table()->views;
  for (std::uint32_t d = 0; d < views.size(); ++d)
    if (views[d] && s.queues.waiting(d) > most) {
      most = s.queues.waiting(d);
      best = d;
    }
  return best;
}

// The mutex is held. Empty task: nothing to do now.
Task take_task(RankState& s) {
  Task task;
  task.table = s.residency.table();
  const auto fullest = fullest_resident(s);
  const bool may_generate = !s.paused && s.next_item < s.share.size() && s.allowance > 0;
  if (fullest && (!may_generate || s.queues.waiting(*fullest) >= rays_worth_tracing_first)) {
    task.batch = s.queues.pop(*fullest);
  } else if (may_generate) {
    task.item = s.plan.item(s.share[s.next_item++]);
    ++s.items_in_hand;
    s.allowance -= static_cast<std::int64_t>(s.plan.samples(*task.item));
  }
  return task;
}

void perform(const Task& task, const WorkPlan& plan, PathTracer& tracer) {
  if (task.item) {
    const WorkItem& item = *task.item;
    for (int y = item.pixels.y0; y < item.pixels.y1; ++y)
      for (int x = item.pixels.x0; x < item.pixels.x1; ++x) {
        const WorkPlan::Range samples = plan.samples(item, x, y);
        for (std::uint32_t sample = samples.first; sample < samples.end; ++sample)
          tracer.trace_camera(x, y, sample);
      }
    return;
  }
  RayBatch batch = *task.batch;
  if (batch.kind() == RayKind::path)
    for (const PathRecord& record : batch.records<PathRecord>()) tracer.resume(record, batch.domain());
  else
    for (const ShadowRecord& record : batch.records<ShadowRecord>()) tracer.resume(record, batch.domain());
}

template <class Entry>
void route(RankState& s, const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) {
    if (s.residency.is_local(entry.domain)) {
      s.queues.push(entry.domain, entry.record);
      continue;
    }
    s.outgoing.push(entry.domain, entry.record);
    ++s.outgoing_rays;
    ++s.forwarded_rays;
    s.residency.note_forwarded(entry.domain, 1);
  }
}

// The mutex is held. Rays are counted as born before another thread or rank can see them, and as dead in the
// same step, so that the sums of a round never miss one that is alive.
void publish(RankState& s, const Task& task, Outbox& outbox, TraceCounters& counters) {
  s.counters += counters;
  route(s, outbox.paths);
  route(s, outbox.shadows);
  if (task.item) --s.items_in_hand;
  counters = {};
  outbox.paths.clear();
  outbox.shadows.clear();
}

void work(RankState& s) {
  Outbox outbox;
  TraceCounters counters;
  std::unique_lock lock(s.mutex);
  std::vector<std::uint64_t> visits(s.visits.size());
  while (!s.finished) {
    Task task = take_task(s);
    if (!task.batch && !task.item) {
      task.table.reset();
      const auto start = Clock::now();
      ++s.workers_waiting;
      s.load_wanted.notify_one();
      s.work_available.wait(lock);
      --s.workers_waiting;
      s.idle_s += seconds_since(start);
      continue;
    }
    lock.unlock();
    const auto start = Clock::now();
    PathTracer tracer(s.scene, task.table->views, s.film, outbox, counters, visits);
    perform(task, s.plan, tracer);
    task.table.reset();
    const double busy = seconds_since(start);
    lock.lock();
    s.trace_s += busy;
    const bool more = !outbox.paths.empty() || !outbox.shadows.empty();
    publish(s, task, outbox, counters);
    if (more) {
      s.load_wanted.notify_one();
      if (s.workers_waiting > 0) s.work_available.notify_one();
    }
  }
  for (std::size_t d = 0; d < visits.size(); ++d) s.visits[d] += visits[d];
}

void load(RankState& s) {
  std::unique_lock lock(s.mutex);
  const auto waiting = [&](std::uint32_t domain) { return s.queues.waiting(domain); };
  while (!s.finished) {
    auto reservation = s.residency.reserve(waiting, s.alive, s.workers_waiting == s.workers);
    if (!reservation) {
      // An evicted domain comes free without a notice, when its last worker lets go of it.
      s.load_wanted.wait_for(lock, std::chrono::milliseconds(2));
      continue;
    }
    lock.unlock();
    const auto start = Clock::now();
    auto loaded = s.residency.load(*reservation);
    const double taken = seconds_since(start);
    lock.lock();
    s.load_s += taken;
    s.residency.insert(reservation->domain, std::move(loaded));
    s.work_available.notify_all();
  }
}

// A thread that fails leaves the reason to the rank's loop, which tells the others.
void guarded(RankState& s, void (*body)(RankState&)) {
  try {
    body(s);
  } catch (...) {
    const std::lock_guard lock(s.mutex);
    if (!s.failure) s.failure = std::current_exception();
  }
}

}  // namespace

RankState::RankState(const RenderScene& the_scene, Film& the_film, WorkPlan the_plan, RayQueues the_queues,
                     Residency the_residency)
    : scene(the_scene),
      film(the_film),
      plan(std::move(the_plan)),
      queues(std::move(the_queues)),
      residency(std::move(the_residency)),
      outgoing(scene.manifest.domains.size(), std::nullopt) {}

Workers::Workers(RankState& state, int threads) : state_(state) {
  state.workers = threads;
  for (int i = 0; i < threads; ++i) threads_.emplace_back([&state] { guarded(state, work); });
  threads_.emplace_back([&state] { guarded(state, load); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(state_.mutex);
    state_.finished = true;
  }
  state_.work_available.notify_all();
  state_.load_wanted.notify_all();
}

}  // namespace vitrail
