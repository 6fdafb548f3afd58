// SPDX-License-Identifier: Apache-2.0
// One rank of a job: moves rays between ranks, watches for the end, writes checkpoints. The only thread that
// speaks to the transport.
#pragma once

#include <chrono>
#include <functional>

#include "farm/checkpoint.h"
#include "farm/film_keeper.h"
#include "farm/options.h"
#include "farm/parcel.h"
#include "farm/progress.h"
#include "farm/scheduler/watch.h"
#include "farm/stats.h"
#include "farm/workers.h"

namespace vitrail {

class Rank {
 public:
  // `about`: FilmProgress's. `keeper`: on rank 0, unless it is a dry run.
  Rank(Transport& transport, RankState& state, const RenderOptions& options, const Goal& goal,
       EarlierWork earlier, std::string about, FilmKeeper* keeper);
  ~Rank();
  Rank(const Rank&) = delete;
  Rank& operator=(const Rank&) = delete;

  // Until the picture is whole, the time is up or the job is told to stop. Rank 0 has then written the film,
  // or a checkpoint where a signal stopped it. Throws what went wrong here, or OtherRankFailed, after all
  // ranks have agreed to end.
  Ending run();

  void add_to(RenderStats& stats) const;
  int rounds() const { return rounds_; }  // begun here

 private:
  enum class Decision { go_on, checkpoint, end };

  bool try_to_move_rays();
  bool move_rays();
  std::vector<RayBatch> take_outgoing();
  int destination(const RayBatch& batch);
  void send(std::vector<RayBatch> batches);
  void send(int to, Parcel parcel, std::int64_t rays);
  bool may_come(RayBatch& batch) const;
  std::uint64_t items_of_phase() const;
  void join_round();
  Decision decide(const Round& round);
  Ending ending_of(const RoundSums& sums) const;
  static Ending stop_of(const RoundSums& sums);
  void start_items(std::vector<std::uint64_t> done);
  void deal(std::vector<std::uint64_t> share);
  void give_items();
  std::optional<Ending> begin_next_round(Ending stop);
  void begin_iteration(std::uint32_t iteration);
  bool begin_next_phase(const RoundSums& sums);
  void take_in(RayBatch batch);
  void write(const std::filesystem::path& file, bool last);
  void note(Timeline::Kind kind, std::chrono::steady_clock::time_point begin, const Timeline::Values& values);
  void note_counters(std::int64_t rays_waiting);
  void watch_clock();
  void watch_ranks();
  void answer_during(const std::function<void()>& work);
  std::optional<Ending> act_on(Decision decision, const RoundSums& sums);
  void leave_together();
  double elapsed_s() const;
  void expect_ending(double gather_s);

  Transport& transport_;
  RankState& state_;
  const RenderOptions& options_;
  const Goal& goal_;
  int rounds_ = 1;
  Progress progress_;
  Watch watch_;
  std::uint64_t items_before_ = 0;  // on rank 0: done by earlier runs or rounds; of earlier iterations here
  // Of photon mapping: what was done before this run, and the job's items up to this iteration's last.
  std::vector<std::uint64_t> done_before_;
  std::uint64_t items_until_ = 0;
  double time_before_s_ = 0;  // render time of earlier runs
  std::string about_;
  FilmKeeper* keeper_;
  bool want_checkpoint_ = false, time_is_up_ = false;
  // On rank 0, where time is limited: what is left for the film, of which the first is but for gathering.
  double write_s_ = 0, ending_s_ = 0;
  bool has_gained_ = false;      // items are done that were not when this run began
  std::uint32_t sent_from_ = 0;  // the domain that is looked at first when rays are sent
  std::uint64_t messages_ = 0, received_ = 0, sent_bytes_ = 0;
  std::chrono::steady_clock::time_point start_, limit_start_, last_checkpoint_, last_counters_;
  std::optional<std::chrono::steady_clock::time_point> pause_;  // since when the job empties for a checkpoint
  std::uint64_t checkpoints_ = 0;                               // written or tried
  double checkpoints_s_ = 0, longest_checkpoint_s_ = 0;         // from the pause until work goes on
  double checkpoint_after_s_;                                   // since the last one; 0: never
};

}  // namespace vitrail
