// SPDX-License-Identifier: Apache-2.0
#include "farm/workers.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <system_error>

#include "scene/diagnostics.h"
#include "scene/resource_usage.h"

namespace vitrail {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What a worker does next: a batch of waiting rays, or a work item.
struct Task {
  Scheduler::Work work = Scheduler::Work::none;
  RayBatch batch;
  WorkItem item;
  std::uint64_t first = 0, end = 0;  // samples of the item, or photons by number
  bool photons = false;
  std::shared_ptr<const ResidentTable> table;
};

// The mutex is held. Empty task: nothing to do now.
Task take_task(RankState& s) {
  Task task;
  task.table = s.domains.table();
  if (s.photons && !s.photons->questions.empty()) {
    task.work = Scheduler::Work::trace;
    task.batch = std::move(s.photons->questions.back());
    s.photons->questions.pop_back();
    return task;
  }
  const Scheduler::Task next = s.scheduler.next_task();
  task.work = next.work;
  if (next.work == Scheduler::Work::trace) {
    task.batch = s.queues.pop(next.domain);
    s.scheduler.begin_batch(next.domain, task.batch.count());
  } else if (next.work == Scheduler::Work::generate && s.photons && s.photons->flying()) {
    const std::uint64_t chunk = s.share.back(), all = s.photons->photons_in(chunk);
    const std::uint64_t first = s.item_at, end = std::min(all, first + next.rays);
    s.item_at = end == all ? 0 : end;
    task.photons = true;
    task.first = chunk * PhotonWork::chunk_photons + first;
    task.end = chunk * PhotonWork::chunk_photons + end;
    s.scheduler.begin_rays(end - first, end == all);
    if (end == all) s.share.pop_back();
  } else if (next.work == Scheduler::Work::generate) {
    const std::uint64_t item = s.share.back();
    task.item = s.plan.item(item);
    const std::uint64_t samples = s.plan.samples(task.item);
    task.first = s.item_at;
    task.end = std::min(samples, s.item_at + next.rays);
    s.item_at = task.end == samples ? 0 : task.end;
    s.scheduler.begin_rays(task.end - task.first, task.end == samples);
    if (task.end == samples) {
      s.share.pop_back();
      s.done[item / 64] |= std::uint64_t{1} << (item % 64);
    }
  }
  return task;
}

// `traced` is called behind every ray.
template <class Traced>
void perform(Task& task, const WorkPlan& plan, PathTracer& tracer, const Traced& traced) {
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
    resume_all(batch.records<PathRecord>());
  else if (batch.kind() == RayKind::question)
    for (const Gather& question : batch.records<Gather>()) {
      tracer.answer(question);
      traced();
    }
  else
    resume_all(batch.records<ShadowRecord>());
}

template <class Entry>
void route(RankState& s, const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) {
    const bool here = s.scheduler.route(entry.domain, 1);
    (here ? s.queues : s.outgoing).push(entry.domain, entry.record);
  }
}

// Photons that landed, and questions, count as rays while they are on their way.
void send_photons_and_questions(RankState& s, const Outbox& outbox, TraceCounters& counters) {
  for (const Photon& photon : outbox.photons)
    s.photons->deal_out(photon, [&](std::uint32_t domain) {
      s.outgoing.push(domain, photon);
      s.scheduler.goes_out(1);
      ++counters.born;
    });
  for (const Outbox::Question& question : outbox.questions) s.outgoing.push(question.domain, question.record);
  s.scheduler.goes_out(outbox.questions.size());
}

// The mutex is held. Rays are counted as born before another thread or rank can see them, and as dead in the
// same step, so that the sums of a round never miss one that is alive.
void publish(RankState& s, Outbox& outbox, TraceCounters& counters) {
  const bool more = !outbox.paths.empty() || !outbox.shadows.empty();
  send_photons_and_questions(s, outbox, counters);
  s.counters += counters;
  s.scheduler.count(counters.born, counters.died);
  route(s, outbox.paths);
  route(s, outbox.shadows);
  counters = {};
  outbox.paths.clear();
  outbox.shadows.clear();
  outbox.photons.clear();
  outbox.questions.clear();
  if (!more) return;
  s.load_wanted.notify_one();
  if (s.scheduler.workers_waiting() > 0) s.work_available.notify_one();
}

// A task may make far more rays than it takes: a worker holds no more of them than this, some hundred KB.
constexpr std::size_t most_rays_in_hand = 4096;

// Into the timeline, where one is recorded. The mutex is held.
void note_task(RankState& s, int thread, Clock::time_point begin, const Task& task) {
  if (task.work == Scheduler::Work::generate)
    s.timeline->add(Timeline::Kind::generate, thread, begin, Clock::now(),
                    {static_cast<std::int64_t>(task.end - task.first)});
  else
    s.timeline->add(Timeline::Kind::trace, thread, begin, Clock::now(),
                    {task.batch.domain(), static_cast<std::int64_t>(task.batch.count())});
}

// A worker that is woken in vain goes on to be idle. The mutex is held.
void note_idleness(RankState& s, int thread, std::optional<Clock::time_point>& since) {
  if (s.timeline && since) s.timeline->add(Timeline::Kind::idle, thread, *since, Clock::now());
  since.reset();
}

void work(RankState& s, int thread) {
  Outbox outbox;
  TraceCounters counters;
  std::unique_lock lock(s.mutex);
  std::optional<RayTraffic> traffic;
  if (s.traffic) traffic.emplace(s.scene.manifest.domains.size());
  std::optional<Clock::time_point> idle_since;
  while (!s.finished) {
    Task task = take_task(s);
    if (task.work == Scheduler::Work::none) {
      task.table.reset();
      const auto start = Clock::now();
      s.scheduler.worker_waits();
      s.load_wanted.notify_one();
      s.work_available.wait(lock);
      s.scheduler.worker_wakes();
      s.idle_s += seconds_since(start);
      if (!idle_since) idle_since = start;
      continue;
    }
    note_idleness(s, thread, idle_since);
    lock.unlock();
    const Clock::time_point begin = s.timeline ? Clock::now() : Clock::time_point();
    const double start = thread_cpu_seconds();
    PathTracer tracer(s.scene, task.table->views, s.film, outbox, counters, traffic ? &*traffic : nullptr,
                      s.photons ? &s.photons->pass() : nullptr);
    perform(task, s.plan, tracer, [&] {
      if (outbox.size() < most_rays_in_hand) return;
      const std::lock_guard now(s.mutex);
      publish(s, outbox, counters);
    });
    task.table.reset();
    if (traffic) traffic->end();
    const double busy = thread_cpu_seconds() - start;
    lock.lock();
    s.trace_s += busy;
    if (s.timeline) note_task(s, thread, begin, task);
    publish(s, outbox, counters);
    s.scheduler.finish_task(task.end - task.first);
  }
  note_idleness(s, thread, idle_since);
  if (traffic) s.traffic->add(*traffic);
}

std::int64_t bytes_of(const LoadStep::Load& load, const Manifest& manifest) {
  std::uint64_t bytes = manifest.domains[load.domain].bytes;
  for (const std::uint32_t object : load.missing) bytes += manifest.objects[object].bytes;
  return static_cast<std::int64_t>(bytes);
}

void load(RankState& s, int thread) {
  std::unique_lock lock(s.mutex);
  while (!s.finished) {
    s.scheduler.released(s.domains.take_released());
    const auto reservation = s.domains.begin(s.scheduler.loader_is_free());
    if (!reservation) {
      // An evicted domain comes free without a notice, when its last worker lets go of it.
      s.load_wanted.wait_for(lock, std::chrono::milliseconds(2));
      continue;
    }
    lock.unlock();
    const auto start = Clock::now();
    auto loaded = s.domains.load(*reservation);
    const auto end = Clock::now();
    lock.lock();
    s.load_s += std::chrono::duration<double>(end - start).count();
    if (s.timeline)
      s.timeline->add(Timeline::Kind::load, thread, start, end,
                      {reservation->load.domain, bytes_of(reservation->load, s.scene.manifest)});
    s.domains.insert(reservation->load.domain, std::move(loaded));
    s.scheduler.loaded(reservation->load.domain);
    s.work_available.notify_all();
  }
}

// A thread that fails leaves the reason to the rank's loop, which tells the others.
void guarded(RankState& s, int thread, void (*body)(RankState&, int)) {
  try {
    body(s, thread);
  } catch (...) {
    const std::lock_guard lock(s.mutex);
    if (!s.failure) s.failure = std::current_exception();
  }
}

}  // namespace

RankState::RankState(const RenderScene& the_scene, Film& the_film, WorkPlan the_plan, RayQueues the_queues,
                     RayQueues the_outgoing, Scheduler the_scheduler, const std::filesystem::path& bundle)
    : scene(the_scene),
      film(the_film),
      plan(std::move(the_plan)),
      scheduler(std::move(the_scheduler)),
      queues(std::move(the_queues)),
      outgoing(std::move(the_outgoing)),
      domains(scene.manifest, bundle) {}

Workers::Workers(RankState& state, int threads) : state_(state) {
  try {
    for (int i = 0; i < threads + loaders_of_a_rank; ++i)
      threads_.emplace_back([&state, i, threads] { guarded(state, i + 1, i < threads ? work : load); });
  } catch (const std::system_error& e) {
    const std::size_t made = threads_.size();
    end();
    throw MachineError(
        fmt::format("only {} of {} threads can be made: {}", made, threads + loaders_of_a_rank, e.what()));
  }
}

Workers::~Workers() { end(); }

void Workers::end() {
  {
    const std::lock_guard lock(state_.mutex);
    state_.finished = true;
  }
  state_.work_available.notify_all();
  state_.load_wanted.notify_all();
  threads_.clear();  // joins
}

}  // namespace vitrail
