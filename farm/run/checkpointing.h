// SPDX-License-Identifier: Apache-2.0
// Checkpointing decides when the film is written while a job goes on and at its end, and measures what that
// takes. Rank 0 has the clock.
#pragma once

#include <optional>
#include <string>

#include "farm/files/film_keeper.h"
#include "farm/run/drain_time.h"
#include "farm/run/rank_state.h"
#include "farm/run/stats.h"
#include "farm/transport/transport.h"

namespace vitrail {

class Checkpointing {
 public:
  // `about` is FilmProgress's, and outlives it. `keeper` is set on rank 0, unless it is a dry run.
  // `time_before_s` is the render time of earlier runs.
  Checkpointing(Transport& transport, RankState& state, const RenderOptions& options, FilmKeeper* keeper,
                const std::string& about, double time_before_s);

  // Asks for a checkpoint or an end where one is due. Where domains come and go, or rays go to other ranks,
  // and time is limited, an early checkpoint measures how long the rays alive take to end; that is left
  // before the limit.
  void watch_clock();
  void rays_are_alive(std::int64_t rays) { rays_alive_ = rays; }
  // Notes that items are done that were not when this run began: before that no time limit ends it.
  void has_gained() { has_gained_ = true; }
  bool wanted() const { return wanted_; }
  bool time_is_up() const { return time_is_up_; }
  // Notes that the job empties from now on, so that the film can be written.
  void pause_begins() {
    if (pause_) return;
    pause_ = RankState::Clock::now();
    alive_at_pause_ = rays_alive_;
  }
  // All ranks call these together, while no ray is alive; no worker begins before the film is written.
  void write_checkpoint();
  void write_last(bool as_film);
  // Puts the film together on rank 0 between rounds.
  void gather();

  void add_to(RenderStats& stats) const;

 private:
  bool write(const std::filesystem::path& file, bool last);
  void expect_ending(double gather_s);
  void work_goes_on(bool written);
  double time_limit_s() const;
  double drain_s() const;
  bool drain_is_to_be_tried() const;

  Transport& transport_;
  RankState& state_;
  const RenderOptions& options_;
  FilmKeeper* keeper_;
  const std::string& about_;
  double time_before_s_;
  bool wanted_ = false, time_is_up_ = false, has_gained_ = false;
  // Rank 0 sets them where time is limited: the seconds for writing the film, and for all of its end, which
  // begins with gathering it.
  double write_s_ = 0, ending_s_ = 0;
  RankState::Clock::time_point limit_start_, last_;
  double due_after_s_;  // since the last one; 0: never
  // The next checkpoint is due at this time since the start, where somebody looks at checkpoints: soon, then
  // after twice the time and so on.
  double next_look_s_ = 0.25;
  std::optional<RankState::Clock::time_point> pause_;  // since when the job empties
  DrainTime drain_;
  std::int64_t rays_alive_ = 0, alive_at_pause_ = 0;
  std::uint64_t checkpoints_ = 0;                        // written or tried
  double checkpoints_s_ = 0, longest_checkpoint_s_ = 0;  // from the pause until work goes on
};

}  // namespace vitrail
