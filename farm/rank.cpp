// SPDX-License-Identifier: Apache-2.0
#include "farm/rank.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <csignal>
#include <future>
#include <map>
#include <thread>

#include "bundle/watched_files.h"
#include "farm/agreement.h"
#include "farm/ending_time.h"
#include "farm/parcel.h"
#include "farm/render.h"
#include "farm/signals.h"
#include "scene/diagnostics.h"
#include "scene/say.h"

namespace vitrail {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// The loop naps while nothing moves, longer and longer: a rank that spins takes the core from one that works.
constexpr auto shortest_nap = 20us, longest_nap = 1000us;

// Between checkpoints, so that work goes on in between however often they are asked for. 0: never.
double interval_s(const RenderOptions& options) {
  constexpr double shortest_s = 0.05;
  return options.checkpoint_every_s > 0 ? std::max(options.checkpoint_every_s, shortest_s) : 0;
}

std::uint64_t bits_set(const std::vector<std::uint64_t>& words) {
  std::uint64_t sum = 0;
  for (std::uint64_t word : words) sum += static_cast<std::uint64_t>(std::popcount(word));
  return sum;
}

}  // namespace

Rank::Rank(Transport& transport, RankState& state, const RenderOptions& options, const Goal& goal,
           EarlierWork earlier, std::string about, FilmKeeper* keeper)
    : transport_(transport),
      state_(state),
      options_(options),
      goal_(goal),
      progress_(options, transport.rank(), state.film, expected_samples(state.film, goal)),
      watch_(transport.rank(), transport.size(), options.patience_s),
      time_before_s_(earlier.render_time_s),
      about_(std::move(about)),
      keeper_(keeper),
      start_(Clock::now()),
      limit_start_(limit_start(options, start_)),
      last_checkpoint_(start_),
      checkpoint_after_s_(interval_s(options)) {
  if (state.photons) {
    done_before_ = earlier.done;
    items_until_ = bits_set(earlier.done);
  }
  start_items(std::move(earlier.done));
  if (state.photons) begin_iteration(0);
  if (keeper_ && options.time_limit_s > 0) write_s_ = keeper_->time_to_write_s();
  expect_ending(0);
  transport_.while_waiting = [this] { watch_ranks(); };
}

Rank::~Rank() { transport_.while_waiting = nullptr; }

double Rank::elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

// Deals out those items of the state's plan that are not done; no worker has begun, or the mutex is held.
void Rank::start_items(std::vector<std::uint64_t> done) {
  if (state_.plan.adaptive()) {
    done.resize((state_.plan.items() + 63) / 64);
    mark_empty_items(state_.plan, done);
  }
  if (!state_.photons)  // theirs are dealt out an iteration at a time
    deal(share_of(state_.plan, done, transport_.rank(), transport_.size()));
  state_.done.assign((state_.plan.items() + 63) / 64, 0);
  if (transport_.rank() != 0) return;
  items_before_ = bits_set(done);
  if (!done.empty()) state_.done = std::move(done);
}

// No worker has begun, or the mutex is held.
void Rank::deal(std::vector<std::uint64_t> share) {
  std::ranges::reverse(share);
  state_.share = std::move(share);
  state_.scheduler.begin_items(state_.share.size());
}

// The first one from `iteration` on that is not done; no worker has begun, or the mutex is held.
void Rank::begin_iteration(std::uint32_t iteration) {
  const WorkPlan& plan = state_.plan;
  const std::uint64_t a_pass = plan.tiles_x() * plan.tiles_y();
  const auto open = [&] {
    return share_of(done_before_, iteration * a_pass, (iteration + 1) * a_pass, 0, 1);
  };
  while (iteration + 1 < plan.samples() && open().empty()) ++iteration;
  items_until_ += open().size();
  state_.photons->begin_flying(iteration);
  deal(state_.photons->chunks_of_this_rank());
}

// No ray is alive. False where what was begun is not at its end, or nothing is left: the same on every rank.
bool Rank::begin_next_phase(const RoundSums& sums) {
  const auto done = static_cast<std::uint64_t>(sums.items_done);
  if (state_.photons->flying()) {
    if (done < state_.photons->chunks()) return false;
    const std::lock_guard lock(state_.mutex);
    state_.photons->begin_gathering();
    const std::uint64_t a_pass = state_.plan.tiles_x() * state_.plan.tiles_y(),
                        first = state_.photons->pass().iteration * a_pass;
    deal(share_of(done_before_, first, first + a_pass, transport_.rank(), transport_.size()));
  } else {
    if (done < items_until_ || done == state_.plan.items()) return false;
    const std::lock_guard lock(state_.mutex);
    items_before_ += state_.scheduler.items_dealt();
    begin_iteration(state_.photons->pass().iteration + 1);
  }
  state_.work_available.notify_all();
  return true;
}

Ending Rank::run() {
  auto nap = std::chrono::microseconds(shortest_nap);
  const std::chrono::duration<double> round_interval(round_interval_s(transport_.size()));
  Clock::time_point last_round;
  bool in_round = false;
  for (;;) {
    bool moved = try_to_move_rays();
    watch_clock();
    watch_ranks();
    if (in_round) {
      if (const auto round = transport_.finish_round()) {
        in_round = false;
        watch_.round_ends();
        progress_.show(*round);
        const Decision decision = decide(*round);
        if (decision != Decision::go_on) {
          // What follows is done by all together.
          watch_.round_begins(elapsed_s());
          const std::optional<Ending> ending = act_on(decision, round->sums);
          watch_.round_ends();
          if (ending) return *ending;
        }
      }
    } else if (Clock::now() - last_round >= round_interval) {
      last_round = Clock::now();
      join_round();
      watch_.round_begins(elapsed_s());
      in_round = moved = true;
    }
    if (moved) {
      nap = shortest_nap;
    } else {
      std::this_thread::sleep_for(nap);
      nap = std::min<std::chrono::microseconds>(nap * 2, longest_nap);
    }
  }
}

// The end of the render, where it is one.
std::optional<Ending> Rank::act_on(Decision decision, const RoundSums& sums) {
  if (decision == Decision::checkpoint) {
    write(checkpoint_path(options_.film), /*last=*/false);
    return std::nullopt;
  }
  Ending ending = ending_of(sums);
  if (ending == Ending::finished && goal_.in_rounds) {
    const std::optional<Ending> end = begin_next_round(stop_of(sums));
    if (!end) return std::nullopt;
    ending = *end;
  }
  if (options_.dry_run)
    transport_.sum_to_root(state_.film.counts());
  else
    write(writes_film(ending) ? options_.film : checkpoint_path(options_.film), /*last=*/true);
  progress_.finish();
  return ending;
}

// What goes wrong is told to the others in the next round.
bool Rank::try_to_move_rays() {
  try {
    return move_rays();
  } catch (...) {
    const std::lock_guard lock(state_.mutex);
    if (!state_.failure) state_.failure = std::current_exception();
    return false;
  }
}

// Takes what has arrived and sends what waits for other ranks. Returns whether anything moved.
bool Rank::move_rays() {
  if (transport_.size() == 1) return false;
  bool moved = false;
  while (const auto message = transport_.receive()) {
    const auto begin = Clock::now();
    ++received_;
    moved = true;
    std::size_t rays = 0;
    for (RayBatch& batch : unpack(message->bytes, state_.scene.manifest.domains.size())) {
      rays += batch.count();
      if (!may_come(batch)) throw MachineError("a message came that holds no rays for a domain of this rank");
      take_in(std::move(batch));
    }
    note(Timeline::Kind::receive, begin,
         {message->from, static_cast<std::int64_t>(message->bytes.size()), static_cast<std::int64_t>(rays)});
  }
  std::vector<RayBatch> batches;
  {
    const std::lock_guard lock(state_.mutex);
    if (!state_.scheduler.send_is_due(elapsed_s())) return moved;
    batches = take_outgoing();
  }
  if (batches.empty()) return moved;
  send(std::move(batches));
  return true;
}

// A message a destination.
void Rank::send(std::vector<RayBatch> batches) {
  struct Filling {
    Parcel parcel;
    std::int64_t rays = 0;
  };
  std::map<int, Filling> parcels;
  const auto send_parcel = [&](int to, Filling& filling) {
    send(to, std::exchange(filling.parcel, {}), std::exchange(filling.rays, 0));
  };
  for (RayBatch& batch : batches) {
    const int to = destination(batch);
    Filling& filling = parcels[to];
    filling.rays += static_cast<std::int64_t>(batch.count());
    filling.parcel.add(std::exchange(batch, {}));
    if (filling.parcel.full()) send_parcel(to, filling);
  }
  for (auto& [to, filling] : parcels)
    if (!filling.parcel.empty()) send_parcel(to, filling);
}

void Rank::send(int to, Parcel parcel, std::int64_t rays) {
  const auto begin = Clock::now();
  std::vector<std::byte> message = parcel.take();
  const auto bytes = static_cast<std::int64_t>(message.size());
  ++messages_;
  sent_bytes_ += message.size();
  transport_.send(to, std::move(message));
  note(Timeline::Kind::send, begin, {to, bytes, rays});
}

// What photons land at and paths ask them for has one place.
int Rank::destination(const RayBatch& batch) {
  if (!is_ray(batch.kind())) return state_.scheduler.residency().homes().first(batch.domain());
  const std::lock_guard lock(state_.mutex);
  return state_.scheduler.destination(batch.domain(), batch.count());
}

// As much as the transport has room for; it begins where the last time ended, so that none waits for ever.
// The mutex is held.
std::vector<RayBatch> Rank::take_outgoing() {
  std::vector<RayBatch> batches;
  std::uint64_t bytes = transport_.sending_bytes(), rays = 0;
  const auto domains = static_cast<std::uint32_t>(state_.scene.manifest.domains.size());
  const std::uint32_t first = sent_from_;
  for (std::uint32_t i = 0; i < domains; ++i) {
    const std::uint32_t d = (first + i) % domains;
    while (!state_.outgoing.empty(d)) {
      sent_from_ = d;
      if (bytes >= state_.most_sent_bytes) break;
      RayBatch& batch = batches.emplace_back(state_.outgoing.pop(d));
      bytes += batch.held_bytes();
      rays += batch.count();
    }
    if (bytes >= state_.most_sent_bytes) break;
  }
  if (rays > 0) state_.scheduler.sent(rays, elapsed_s());
  return batches;
}

// The last ones that it has, so that the picture goes on evenly.
void Rank::give_items() {
  std::vector<std::pair<int, RayBatch>> given;
  {
    const std::lock_guard lock(state_.mutex);
    for (const auto& [to, items] : state_.scheduler.give_items()) {
      const auto first = state_.share.begin(), end = first + static_cast<std::ptrdiff_t>(items);
      RayBatch& batch = given.emplace_back(to, RayBatch(0, RayKind::item)).second;
      std::for_each(first, end, [&](std::uint64_t item) { batch.append(item); });
      state_.share.erase(first, end);
    }
  }
  for (const auto& [to, batch] : given) {
    Parcel parcel;
    parcel.add(batch);
    send(to, std::move(parcel), 0);
  }
}

std::uint64_t Rank::items_of_phase() const {
  return state_.photons && state_.photons->flying() ? state_.photons->chunks() : state_.plan.items();
}

// Nothing but what ranks send each other.
bool Rank::may_come(RayBatch& batch) const {
  if (batch.kind() == RayKind::item)
    return std::ranges::all_of(batch.records<std::uint64_t>(),
                               [&](std::uint64_t item) { return item < items_of_phase(); });
  return (is_ray(batch.kind()) || state_.photons) &&
         state_.scheduler.residency().homes().has(batch.domain(), transport_.rank());
}

void Rank::take_in(RayBatch batch) {
  const std::lock_guard lock(state_.mutex);
  if (batch.kind() == RayKind::item) {
    const std::span<std::uint64_t> items = batch.records<std::uint64_t>();
    state_.share.insert(state_.share.begin(), items.begin(), items.end());
    state_.scheduler.items_arrived(items.size());
    state_.work_available.notify_all();
    return;
  }
  if (batch.kind() == RayKind::landed) {
    for (const Photon& photon : batch.records<Photon>()) state_.photons->land(photon);
    state_.scheduler.count(0, batch.count());
    return;
  }
  if (batch.kind() == RayKind::question) {
    state_.photons->questions.push_back(std::move(batch));
    state_.work_available.notify_one();
    return;
  }
  state_.scheduler.arrived(batch.domain(), batch.count());
  state_.queues.push(std::move(batch));
  state_.work_available.notify_one();
  state_.load_wanted.notify_one();
}

// Into the timeline, where one is recorded: what this thread has done since `begin`.
void Rank::note(Timeline::Kind kind, Clock::time_point begin, const Timeline::Values& values) {
  if (!state_.timeline) return;
  const std::lock_guard lock(state_.mutex);
  state_.timeline->add(kind, 0, begin, Clock::now(), values);
}

// The mutex is held.
void Rank::note_counters(std::int64_t rays_waiting) {
  constexpr auto interval = 50ms;
  const auto now = Clock::now();
  if (now - last_counters_ < interval) return;
  last_counters_ = now;
  const Scheduler& scheduler = state_.scheduler;
  const Residency& domains = scheduler.residency();
  state_.timeline->add(Timeline::Kind::counters, 0, now, now,
                       {rays_waiting, static_cast<std::int64_t>(scheduler.rays_to_send()),
                        static_cast<std::int64_t>(domains.loads() - domains.evictions()),
                        static_cast<std::int64_t>(domains.held_bytes())});
}

void Rank::expect_ending(double gather_s) {
  if (!keeper_ || options_.time_limit_s <= 0) return;
  const std::chrono::duration<double> gone = start_ - limit_start_;
  ending_s_ =
      std::min((options_.time_limit_s - gone.count()) / 2,
               ending_time_s(options_, film_bytes(state_.scene.manifest.film, state_.film.key().splats),
                             transport_.size(), write_s_, gather_s));
}

void Rank::watch_clock() {
  if (take_checkpoint_signal() && !options_.dry_run) want_checkpoint_ = true;
  if (transport_.rank() != 0) return;
  const auto since_checkpoint = std::chrono::duration<double>(Clock::now() - last_checkpoint_).count();
  if (checkpoint_after_s_ > 0 && since_checkpoint >= checkpoint_after_s_) want_checkpoint_ = true;
  const double since_start_s = std::chrono::duration<double>(Clock::now() - options_.start).count();
  const double limited_s = std::chrono::duration<double>(Clock::now() - limit_start_).count();
  if (options_.time_limit_s > 0 && has_gained_ && limited_s + ending_s_ >= options_.time_limit_s)
    time_is_up_ = true;
  if (options_.stop_after_s > 0 && since_start_s >= options_.stop_after_s) ask_to_stop();
}

// Answers those that ask whether this rank is well, and asks itself where a round does not end.
void Rank::watch_ranks() {
  while (const auto heard = transport_.hear()) {
    const auto [from, word] = *heard;
    if (word == Transport::Word::here) {
      watch_.answered(from);
    } else {
      watch_.asked(elapsed_s());
      transport_.say(from, Transport::Word::here);
    }
  }
  const Watch::Step step = watch_.step(elapsed_s());
  if (step == Watch::Step::ask_all)
    for (int other = 0; other < transport_.size(); ++other)
      if (other != transport_.rank()) transport_.say(other, Transport::Word::are_you_there);
  if (step != Watch::Step::give_up) return;
  const std::vector<int> silent = watch_.silent();
  const bool one = silent.size() == 1;
  say("vitrail: rank {} of {}: {} {} {} not answered for {} s (--patience): the job ends; what its last "
      "checkpoint holds is not lost, the same command goes on from there\n",
      transport_.rank(), transport_.size(), one ? "rank" : "ranks", fmt::join(silent, ", "),
      one ? "has" : "have", options_.patience_s);
  constexpr int machine_failed = 4;    // the exit status of that
  transport_.abandon(machine_failed);  // at once: what stopped them may have stopped this rank's loader too
}

// A disk may take longer than the others have patience with a rank.
void Rank::answer_during(const std::function<void()>& work) {
  if (transport_.size() == 1) return work();
  std::future<void> working = std::async(std::launch::async, work);
  while (working.wait_for(longest_nap) != std::future_status::ready) watch_ranks();
  working.get();
}

void Rank::join_round() {
  const std::lock_guard lock(state_.mutex);
  RoundSums mine = state_.scheduler.contribution();
  const RankReport report = state_.scheduler.report();
  if (state_.timeline) note_counters(report.waiting);
  mine.pause = want_checkpoint_;
  mine.interrupted = stop_signal() == SIGINT;
  mine.terminated = stop_signal() == SIGTERM;
  mine.time_is_up = time_is_up_;
  if (state_.failure) (is_bad_input(state_.failure) ? mine.bad_input : mine.machine_failure) = 1;
  mine.samples = static_cast<std::int64_t>(state_.counters.rays_camera);
  if (!state_.photons || !state_.photons->flying())
    mine.items_done += static_cast<std::int64_t>(items_before_);
  const TraceCounters& c = state_.counters;
  mine.rays_traced = static_cast<std::int64_t>(c.rays_camera + c.rays_indirect + c.rays_shadow);
  transport_.start_round(mine, report);
}

// The same on every rank, since the sums are.
Rank::Decision Rank::decide(const Round& round) {
  const RoundSums& sums = round.sums;
  const bool flying = state_.photons && state_.photons->flying();
  has_gained_ = has_gained_ || (!flying && sums.items_done > static_cast<std::int64_t>(items_before_));
  if (sums.pause > 0 && !pause_) pause_ = Clock::now();
  if (sums.bad_input + sums.machine_failure > 0) {
    leave_together();
    std::exception_ptr mine;
    {
      const std::lock_guard lock(state_.mutex);
      mine = state_.failure;
    }
    leave(mine, sums);
  }
  auto quiet = Scheduler::Decision::go_on;
  {
    const std::lock_guard lock(state_.mutex);
    state_.scheduler.ranks_told(std::make_shared<const std::vector<RankReport>>(round.ranks));
    quiet = state_.scheduler.decide(sums);
  }
  state_.work_available.notify_all();
  give_items();
  if (quiet == Scheduler::Decision::go_on) return Decision::go_on;
  if (state_.photons && begin_next_phase(sums)) return Decision::go_on;
  return ending_of(sums) == Ending::none ? Decision::checkpoint : Decision::end;
}

Ending Rank::ending_of(const RoundSums& sums) const {
  const bool flying = state_.photons && state_.photons->flying();
  if (!flying && sums.items_done == static_cast<std::int64_t>(state_.plan.items())) return Ending::finished;
  return stop_of(sums);
}

Ending Rank::stop_of(const RoundSums& sums) {
  if (sums.terminated > 0) return Ending::terminated;
  if (sums.interrupted > 0) return Ending::interrupted;
  return sums.time_is_up > 0 ? Ending::time_is_up : Ending::none;
}

// All items of a round are done and no ray is alive. Returns how the render ends: with the last round, or
// with `stop` where that is one; empty if another round has begun.
std::optional<Ending> Rank::begin_next_round(Ending stop) {
  const double before_s = elapsed_s();
  gather_film(transport_, state_.film, state_.done);
  expect_ending(elapsed_s() - before_s);
  std::optional<NextRound> next;
  agree(transport_, [&] {
    if (transport_.rank() == 0) next = next_round(state_.film, goal_);
  });
  auto plan = agree_on_round(transport_, std::move(next), state_.film, state_.plan);
  if (!plan) return Ending::finished;
  if (stop != Ending::none) return stop;
  if (transport_.rank() == 0) progress_.expect(expected_samples(state_.film, goal_));
  {
    const std::lock_guard lock(state_.mutex);
    // A uniform round's items come behind those done.
    std::vector<std::uint64_t> done;
    if (!plan->adaptive()) done = all_done(state_.plan.items());
    state_.plan = std::move(*plan);
    done.resize((state_.plan.items() + 63) / 64);
    start_items(std::move(done));
  }
  state_.work_available.notify_all();
  ++rounds_;
  return std::nullopt;
}

// No ray is alive, and no worker begins before it is written.
void Rank::write(const std::filesystem::path& file, bool last) {
  const auto begin = Clock::now();
  const double render_time_s = time_before_s_ + elapsed_s();
  agree(transport_, require_unchanged_files);
  gather_film(transport_, state_.film, state_.done);
  bool written = true;
  agree(transport_, [&] {
    if (transport_.rank() != 0) return;
    const FilmProgress progress = progress_of(state_.plan, state_.done, render_time_s, about_);
    answer_during([&] {
      if (last)
        keeper_->write_last(file, state_.film, progress);
      else
        written = keeper_->write_checkpoint(file, state_.film, progress);
    });
    if (!last && written && options_.after_checkpoint && state_.film.samples() > 0)
      options_.after_checkpoint(file);
  });
  {
    const std::lock_guard lock(state_.mutex);
    state_.scheduler.resume();
  }
  note(Timeline::Kind::write, begin, {});
  if (!last && pause_) {
    const double pause_s = std::chrono::duration<double>(Clock::now() - *pause_).count();
    ++checkpoints_;
    checkpoints_s_ += pause_s;
    longest_checkpoint_s_ = std::max(longest_checkpoint_s_, pause_s);
    pause_.reset();
  }
  want_checkpoint_ = false;
  last_checkpoint_ = Clock::now();
  checkpoint_after_s_ = interval_s(options_);
  if (!written && !(checkpoint_after_s_ > 0 && checkpoint_after_s_ < FilmKeeper::retry_s))
    checkpoint_after_s_ = FilmKeeper::retry_s;
}

// After a failure: no rank may end while a message to it or from it is under way. Batches sent and received
// are counted until the sums agree.
void Rank::leave_together() {
  {
    const std::lock_guard lock(state_.mutex);
    state_.finished = true;
  }
  state_.work_available.notify_all();
  for (;;) {
    RoundSums mine;
    mine.born = static_cast<std::int64_t>(messages_);
    mine.died = static_cast<std::int64_t>(received_);
    transport_.start_round(mine, {});
    watch_.round_begins(elapsed_s());
    std::optional<Round> round;
    while (!(round = transport_.finish_round())) {
      watch_ranks();
      while (transport_.receive()) ++received_;
      std::this_thread::sleep_for(shortest_nap);
    }
    watch_.round_ends();
    if (round->sums.born == round->sums.died) return;
  }
}

void Rank::add_to(RenderStats& stats) const {
  stats.traced = state_.counters;
  stats.load_s = state_.load_s;
  stats.trace_s = state_.trace_s;
  stats.idle_s = state_.idle_s;
  stats.forwarded_rays = state_.scheduler.forwarded_rays();
  stats.forwarded_bytes = sent_bytes_;
  stats.messages = messages_;
  stats.checkpoints = checkpoints_;
  stats.checkpoint_s = checkpoints_s_;
  stats.longest_checkpoint_s = longest_checkpoint_s_;
  stats.items_given = state_.scheduler.items_given();
  stats.spilled_bytes = state_.queues.written_bytes() + state_.outgoing.written_bytes();
  stats.domain_loads = state_.scheduler.residency().loads();
  stats.evictions = state_.scheduler.residency().evictions();
  if (state_.photons) {
    stats.photons_landed = state_.photons->landed;
    stats.photons_kept = state_.photons->most_kept;
  }
}

}  // namespace vitrail
