// SPDX-License-Identifier: Apache-2.0
#include "farm/run/phases.h"

#include <algorithm>
#include <bit>

namespace vitrail {

namespace {

std::uint64_t bits_set(const std::vector<std::uint64_t>& words) {
  std::uint64_t sum = 0;
  for (std::uint64_t word : words) sum += static_cast<std::uint64_t>(std::popcount(word));
  return sum;
}

std::uint64_t words_of(const WorkPlan& plan) { return (plan.items() + 63) / 64; }

std::uint64_t items_a_pass(const WorkPlan& plan) { return plan.tiles_x() * plan.tiles_y(); }

}  // namespace

Phases::Phases(RankState& state, const Place& place, std::vector<std::uint64_t> done)
    : state_(state), place_(place) {
  const Locked locked(state);
  if (state.photons) {
    done_before_ = done;
    items_until_ = bits_set(done);
  }
  start_items(locked, std::move(done));
  if (state.photons) begin_iteration(locked, 0);
}

std::uint64_t Phases::items() const {
  return state_.photons_fly() ? state_.photons->chunks() : state_.plan.items();
}

std::int64_t Phases::items_done_before() const {
  return state_.photons_fly() ? 0 : static_cast<std::int64_t>(items_before_);
}

bool Phases::all_done(const RoundSums& sums) const {
  return !state_.photons_fly() && sums.items_done == static_cast<std::int64_t>(state_.plan.items());
}

// Deals out those items of the state's plan that are not done.
void Phases::start_items(const Locked& locked, std::vector<std::uint64_t> done) {
  if (state_.plan.adaptive()) {
    done.resize(words_of(state_.plan));
    mark_empty_items(state_.plan, done);
  }
  if (!state_.photons) {  // theirs are dealt out an iteration at a time
    std::vector<std::uint64_t> items = share_of(state_.plan, done, place_.rank, place_.ranks);
    put_passes_together(state_.plan, items);
    deal(locked, std::move(items));
  }
  state_.done.assign(words_of(state_.plan), 0);
  if (place_.rank != 0) return;
  items_before_ = bits_set(done);
  if (!done.empty()) state_.done = std::move(done);
}

void Phases::deal(const Locked&, std::vector<std::uint64_t> items) {
  std::ranges::reverse(items);
  state_.share.items = std::move(items);
  state_.scheduler.begin_items(state_.share.items.size());
}

// The first one from `iteration` on that is not done.
void Phases::begin_iteration(const Locked& locked, std::uint32_t iteration) {
  const std::uint64_t a_pass = items_a_pass(state_.plan);
  const auto open = [&] {
    return share_of(done_before_, iteration * a_pass, (iteration + 1) * a_pass, 0, 1);
  };
  while (iteration + 1 < state_.plan.samples() && open().empty()) ++iteration;
  items_until_ += open().size();
  state_.photons->begin_flying(iteration);
  deal(locked, state_.photons->chunks_of_this_rank());
}

bool Phases::begin_next(const RoundSums& sums) {
  if (!state_.photons) return false;
  const auto done = static_cast<std::uint64_t>(sums.items_done);
  const bool begun = state_.photons->flying() ? begin_gathering(done) : begin_next_iteration(done);
  if (begun) state_.work_available.notify_all();
  return begun;
}

bool Phases::begin_gathering(std::uint64_t chunks_flown) {
  if (chunks_flown < state_.photons->chunks()) return false;
  const Locked locked(state_);
  state_.photons->begin_gathering();
  const std::uint64_t a_pass = items_a_pass(state_.plan), first = state_.photons->pass().iteration * a_pass;
  deal(locked, share_of(done_before_, first, first + a_pass, place_.rank, place_.ranks));
  return true;
}

bool Phases::begin_next_iteration(std::uint64_t items_done) {
  if (items_done < items_until_ || items_done == state_.plan.items()) return false;
  const Locked locked(state_);
  items_before_ += state_.scheduler.items_dealt();
  begin_iteration(locked, state_.photons->pass().iteration + 1);
  return true;
}

void Phases::begin_round(WorkPlan plan) {
  {
    const Locked locked(state_);
    // A uniform round's items come behind those done.
    std::vector<std::uint64_t> done;
    if (!plan.adaptive()) done = vitrail::all_done(state_.plan.items());
    state_.plan = std::move(plan);
    done.resize(words_of(state_.plan));
    start_items(locked, std::move(done));
  }
  state_.work_available.notify_all();
  ++rounds_;
}

}  // namespace vitrail
