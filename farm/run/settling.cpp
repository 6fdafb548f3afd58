// SPDX-License-Identifier: Apache-2.0
#include "farm/run/settling.h"

#include <algorithm>
#include <limits>

namespace vitrail {

namespace {

// The first seconds are of loading. The time left has to be worth the recording, which costs a few hundredths
// of its time, and then the loading of domains at their new homes.
constexpr double loading_s = 2, recording_s = 5, worth_profiling_s = 50, worth_settling_s = 40;
// One in some 200 is recorded and timed. With fewer the shares of ranks are those of chance.
constexpr std::int64_t rays_a_rank = 1 << 21;

// Samples, less what their rays still have to do: a job begins with millions of rays that wait.
double ended(const RoundSums& sums) {
  const auto samples = static_cast<double>(sums.samples);
  return sums.born > 0 ? samples * static_cast<double>(sums.died) / static_cast<double>(sums.born) : samples;
}

}  // namespace

Settling::Settling(const JobPlan& plan, const RenderOptions& options)
    : wait_s_(loading_s),
      profile_s_(recording_s),
      worth_profiling_s_(worth_profiling_s),
      worth_settling_s_(worth_settling_s),
      ending_s_(options.resources.settle_ending_s),
      rays_(rays_a_rank * plan.scheduler.ranks),
      stage_(plan.may_settle ? Stage::waits : Stage::over) {
  if (!options.resources.settle_after_s) return;
  wait_s_ = worth_profiling_s_ = worth_settling_s_ = 0;
  profile_s_ = *options.resources.settle_after_s;
  rays_ = 0;
}

// By the samples that ended since the stage began.
double Settling::left_s(const RoundSums& sums, const Moment& moment) const {
  const double samples = ended(sums) - ended_then_;
  const double by_samples_s = samples > 0 ? moment.samples_left * (moment.now_s - since_s_) / samples
                                          : std::numeric_limits<double>::infinity();
  return std::min(by_samples_s, moment.until_limit_s);
}

// A job whose first samples are quick may turn out to be long later. A profile is of a whole pass at least:
// tiles of a picture differ.
void Settling::watch(const RoundSums& sums, const Moment& moment) {
  if (stage_ == Stage::waits) {
    if (moment.now_s < wait_s_ || left_s(sums, moment) < worth_profiling_s_) return;
    stage_ = Stage::profiles;
    since_s_ = moment.now_s;
    ended_then_ = ended(sums);
    items_then_ = sums.items_done;
    rays_then_ = sums.rays_traced;
  } else if (stage_ == Stage::profiles && moment.now_s - since_s_ >= profile_s_ &&
             sums.items_done - items_then_ >= moment.items_a_pass && sums.rays_traced - rays_then_ >= rays_) {
    stage_ = left_s(sums, moment) >= worth_settling_s_ ? Stage::settles : Stage::over;
    settles_s_ = moment.now_s;
  }
}

int Settling::settles(double now_s) const {
  if (stage_ != Stage::settles) return 0;
  return now_s - settles_s_ >= ending_s_ ? 2 : 1;
}

}  // namespace vitrail
