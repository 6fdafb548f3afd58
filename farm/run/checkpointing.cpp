// SPDX-License-Identifier: Apache-2.0
#include "farm/run/checkpointing.h"

#include <algorithm>

#include "bundle/watched_files.h"
#include "farm/files/signals.h"
#include "farm/plan/ending_time.h"
#include "farm/run/checkpoint.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "film/film_progress.h"

namespace vitrail {

namespace {

using Clock = RankState::Clock;

double seconds_since(Clock::time_point moment) {
  return std::chrono::duration<double>(Clock::now() - moment).count();
}

// Between checkpoints, so that work goes on in between however often they are asked for. 0: never.
double interval_s(const RenderOptions& options) {
  constexpr double shortest_s = 0.05;
  return options.resources.checkpoint_every_s > 0 ? std::max(options.resources.checkpoint_every_s, shortest_s)
                                                  : 0;
}

}  // namespace

Checkpointing::Checkpointing(Transport& transport, RankState& state, const RenderOptions& options,
                             FilmKeeper* keeper, const std::string& about, double time_before_s)
    : transport_(transport),
      state_(state),
      options_(options),
      keeper_(keeper),
      about_(about),
      time_before_s_(time_before_s),
      limit_start_(limit_start(options, state.begun)),
      last_(state.begun),
      due_after_s_(interval_s(options)) {
  if (keeper_ && options.resources.time_limit_s > 0) write_s_ = keeper_->time_to_write_s();
  expect_ending(0);
}

void Checkpointing::expect_ending(double gather_s) {
  if (!keeper_ || options_.resources.time_limit_s <= 0) return;
  const std::uint64_t bytes = film_bytes(state_.scene.manifest.film, state_.film.key());
  const std::chrono::duration<double> gone = state_.begun - limit_start_;
  ending_s_ = std::min((options_.resources.time_limit_s - gone.count()) / 2,
                       ending_time_s(options_, bytes, transport_.size(), write_s_, gather_s));
}

// From the job's start; 0: there is none.
double Checkpointing::time_limit_s() const {
  const JobResources& r = options_.resources;
  return r.time_limit_s > 0 ? r.time_limit_s : r.stop_after_s;
}

// Half of the time at most: what is there in the end has samples. Where others use the machine it takes 1.65
// times what is expected. A limit that the user sets may pass by a little; one after which the job is killed
// may not.
double Checkpointing::drain_s() const {
  const double margin = options_.resources.time_limit_s > 0 ? 1.25 : 2;
  return std::min(time_limit_s() / 2, margin * drain_.expected_s(rays_alive_));
}

bool Checkpointing::drain_is_to_be_tried() const {
  constexpr double tried_at = 1. / 16;  // of the time
  if (wanted_ || drain_.known() || !keeper_ || time_limit_s() == 0) return false;
  if (state_.elapsed_s() < tried_at * time_limit_s()) return false;
  const Locked locked(state_);
  const Residency& residency = state_.scheduler.residency();
  return residency.evictions() > 0 || !residency.all_are_local();
}

void Checkpointing::watch_clock() {
  if (take_checkpoint_signal() && !options_.outputs.dry_run) wanted_ = true;
  if (transport_.rank() != 0) return;
  if (due_after_s_ > 0 && seconds_since(last_) >= due_after_s_) wanted_ = true;
  if (options_.outputs.after_checkpoint && has_gained_ && state_.elapsed_s() >= next_look_s_) wanted_ = true;
  if (drain_is_to_be_tried()) wanted_ = true;
  if (options_.resources.time_limit_s > 0 && has_gained_ &&
      seconds_since(limit_start_) + ending_s_ + drain_s() >= options_.resources.time_limit_s)
    time_is_up_ = true;
  if (options_.resources.stop_after_s > 0 &&
      seconds_since(options_.resources.start) + drain_s() >= options_.resources.stop_after_s)
    ask_to_stop();
}

void Checkpointing::gather() {
  const Clock::time_point begin = Clock::now();
  now_doing("putting the film together");
  gather_film(transport_, state_.film, state_.done);
  expect_ending(seconds_since(begin));
}

// Returns false where a checkpoint could not be written, which the keeper has told.
bool Checkpointing::write(const std::filesystem::path& file, bool last) {
  const Clock::time_point begin = Clock::now();
  if (pause_) drain_.measured(seconds_since(*pause_), alive_at_pause_);
  const double render_time_s = time_before_s_ + state_.elapsed_s();
  now_doing("looking whether files have changed");
  agree(transport_, require_unchanged_files);
  now_doing("putting the film together");
  gather_film(transport_, state_.film, state_.done);
  now_doing(last ? "writing the film" : "writing a checkpoint");
  bool written = true;
  agree(transport_, [&] {
    if (transport_.rank() != 0) return;
    const FilmProgress progress = progress_of(state_.plan, state_.done, render_time_s, about_);
    if (last)
      keeper_->write_last(file, state_.film, progress);
    else
      written = keeper_->write_checkpoint(file, state_.film, progress);
    if (!last && written && options_.outputs.after_checkpoint && state_.film.samples() > 0)
      options_.outputs.after_checkpoint(file);
  });
  note(state_, Timeline::Kind::write, begin);
  return written;
}

void Checkpointing::write_checkpoint() { work_goes_on(write(checkpoint_path(options_.outputs.film), false)); }

void Checkpointing::write_last(bool as_film) {
  write(as_film ? options_.outputs.film : checkpoint_path(options_.outputs.film), true);
}

void Checkpointing::work_goes_on(bool written) {
  {
    const Locked locked(state_);
    state_.scheduler.resume();
  }
  if (pause_) {
    const double pause_s = seconds_since(*pause_);
    ++checkpoints_;
    checkpoints_s_ += pause_s;
    longest_checkpoint_s_ = std::max(longest_checkpoint_s_, pause_s);
    pause_.reset();
  }
  while (next_look_s_ <= state_.elapsed_s()) next_look_s_ *= 2;
  wanted_ = false;
  last_ = Clock::now();
  due_after_s_ = interval_s(options_);
  if (!written && !(due_after_s_ > 0 && due_after_s_ < FilmKeeper::retry_s))
    due_after_s_ = FilmKeeper::retry_s;
}

void Checkpointing::add_to(RenderStats& stats) const {
  stats.checkpoints = checkpoints_;
  stats.checkpoint_s = checkpoints_s_;
  stats.longest_checkpoint_s = longest_checkpoint_s_;
}

}  // namespace vitrail
