// SPDX-License-Identifier: Apache-2.0
#include "farm/run/workers.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <system_error>

#include "farm/run/tasks.h"
#include "scene/system/diagnostics.h"
#include "scene/system/resource_usage.h"
#include "scene/system/underway.h"
#include "tracer/intersect/embree_domain.h"

namespace vitrail {

namespace {

using Clock = RankState::Clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
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

// Rays are counted as born before another thread or rank can see them, and as dead in the same step, so that
// the sums of a round never miss one that is alive.
void publish(const Locked&, RankState& s, Outbox& outbox, TraceCounters& counters) {
  const bool more = !outbox.rays.empty() || !outbox.shadows.empty();
  send_photons_and_questions(s, outbox, counters);
  s.work.counters += counters;
  s.scheduler.count(counters.born, counters.died);
  route(s, outbox.rays);
  route(s, outbox.shadows);
  counters = {};
  outbox.rays.clear();
  outbox.shadows.clear();
  outbox.photons.clear();
  outbox.questions.clear();
  if (!more) return;
  s.load_wanted.notify_one();
  if (s.scheduler.workers_waiting() > 0) s.work_available.notify_one();
}

// A task may make far more rays than it takes: a worker holds no more of them than this, some hundred KB.
constexpr std::size_t most_rays_in_hand = 4096;

// Into the timeline, where one is recorded.
void note_task(const Locked&, RankState& s, int thread, Clock::time_point begin, const Task& task) {
  if (!s.work.timeline) return;
  if (task.work == Scheduler::Work::generate)
    s.work.timeline->add(Timeline::Kind::generate, thread, begin, Clock::now(),
                         {static_cast<std::int64_t>(task.end - task.first)});
  else
    s.work.timeline->add(Timeline::Kind::trace, thread, begin, Clock::now(),
                         {task.batch.domain(), static_cast<std::int64_t>(task.batch.count())});
}

// A worker that is woken in vain goes on to be idle.
void note_idleness(const Locked&, RankState& s, int thread, std::optional<Clock::time_point>& since) {
  if (s.work.timeline && since) s.work.timeline->add(Timeline::Kind::idle, thread, *since, Clock::now());
  since.reset();
}

// What a worker has in hand, from task to task.
struct Hands {
  Wave wave;
  Outbox outbox;
  TraceCounters counters;
  std::optional<RayTraffic> traffic;
};

// Rays go from domain to domain, as where the one or other is absent.
const KernelFunctions& walking_kernel() {
  static const KernelFunctions kernel = [] {
    KernelFunctions walks = best_kernel();
    walks.domains_closest = [](auto...) { return false; };
    walks.domains_occluded = [](auto...) { return Passage::unknown; };
    return walks;
  }();
  return kernel;
}

const KernelFunctions& kernel_for(Traversal traversal, Profiling::Manner manner) {
  if (traversal == Traversal::embree) return embree_kernel();
  return manner == Profiling::Manner::walking ? walking_kernel() : best_kernel();
}

// Returns seconds of the processor.
double trace(RankState& s, Task& task, Profiling::Manner manner, Hands& hands) {
  const double start = thread_cpu_seconds();
  const bool recorded = hands.traffic && manner == Profiling::Manner::recorded;
  Tracer tracer(
      {s.scene, task.table->views, s.film, hands.outbox, hands.counters, recorded ? &*hands.traffic : nullptr,
       s.photons ? &s.photons->pass() : nullptr, kernel_for(s.domains.traversal(), manner)},
      hands.wave);
  perform(task, s.plan, tracer, [&] {
    if (hands.outbox.size() < most_rays_in_hand) return;
    const Locked locked(s);
    publish(locked, s, hands.outbox, hands.counters);
  });
  tracer.finish();
  task.table.reset();
  if (recorded) hands.traffic->end();
  return thread_cpu_seconds() - start;
}

void wait_for_work(Locked& locked, RankState& s) {
  const auto start = Clock::now();
  s.scheduler.worker_waits();
  s.load_wanted.notify_one();
  locked.wait(s.work_available);
  s.scheduler.worker_wakes();
  s.work.idle_s += seconds_since(start);
}

void work(RankState& s, int thread) {
  Hands hands;
  Locked locked(s);
  std::optional<Clock::time_point> idle_since;
  while (!s.finished) {
    Task task = take_task(locked, s);
    if (task.work == Scheduler::Work::none) {
      task.table.reset();
      if (!idle_since) idle_since = Clock::now();
      wait_for_work(locked, s);
      continue;
    }
    note_idleness(locked, s, thread, idle_since);
    Clock::time_point begin;
    double busy_s = 0;
    const std::uint64_t rays = task.end - task.first + task.batch.count();
    if (s.work.profiling && !hands.traffic) hands.traffic.emplace(s.scene.manifest.domains.size());
    const auto manner = s.work.profiling ? s.work.profiling->next(task.work) : Profiling::Manner::plain;
    locked.without([&] {
      const Underway underway("tracing rays");
      begin = Clock::now();
      busy_s = trace(s, task, manner, hands);
    });
    s.work.trace_s += busy_s;
    if (s.work.profiling) s.work.profiling->took(task.work, manner, rays, busy_s);
    note_task(locked, s, thread, begin, task);
    publish(locked, s, hands.outbox, hands.counters);
    s.scheduler.finish_task(task.end - task.first);
  }
  note_idleness(locked, s, thread, idle_since);
  if (hands.traffic && s.work.profiling) s.work.profiling->traffic.add(*hands.traffic);
}

std::int64_t bytes_of(const LoadStep::Load& load, const Manifest& manifest) {
  std::uint64_t bytes = manifest.domains[load.domain].bytes;
  for (const std::uint32_t object : load.missing) bytes += manifest.objects[object].bytes;
  return static_cast<std::int64_t>(bytes);
}

// An evicted domain comes free without a notice, when its last worker lets go of it: one loader looks for
// that.
void wait_for_loads(Locked& locked, RankState& s) {
  if (s.a_loader_looks) return locked.wait(s.load_wanted);
  s.a_loader_looks = true;
  locked.wait(s.load_wanted, std::chrono::milliseconds(2));
  s.a_loader_looks = false;
}

void load(RankState& s, int thread) {
  Locked locked(s);
  while (!s.finished) {
    s.scheduler.released(s.domains.take_released());
    const auto reservation = s.domains.begin(s.scheduler.loader_is_free());
    if (!reservation) {
      wait_for_loads(locked, s);
      continue;
    }
    s.load_wanted.notify_one();  // the next one may have something to load as well
    Clock::time_point start, end;
    std::shared_ptr<const DomainView> loaded;
    ++s.loads_under_way;
    locked.without([&] {
      const Underway underway("loading a domain");
      start = Clock::now();
      loaded = s.domains.load(*reservation);
      end = Clock::now();
    });
    s.work.load_s += std::chrono::duration<double>(end - start).count();
    if (s.work.timeline)
      s.work.timeline->add(Timeline::Kind::load, thread, start, end,
                           {reservation->load.domain, bytes_of(reservation->load, s.scene.manifest)});
    --s.loads_under_way;
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
    fail(s, std::current_exception());
  }
}

}  // namespace

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
    const Locked locked(state_);
    state_.finished = true;
  }
  state_.work_available.notify_all();
  state_.load_wanted.notify_all();
  threads_.clear();  // joins
}

}  // namespace vitrail
