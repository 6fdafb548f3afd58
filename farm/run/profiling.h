// SPDX-License-Identifier: Apache-2.0
// It holds what `render --profile` and a job that is to settle its homes record. Telling where each ray goes
// costs a render its waves, so tasks take turns: one is recorded, ray by ray; one walks from domain to domain
// as rays do in little memory; one is traced as without a profile. Only the last two tell what tracing costs.
#pragma once

#include <array>
#include <cstdint>

#include "farm/scheduler/scheduler.h"
#include "tracer/rays/ray_traffic.h"

namespace vitrail {

class Profiling {
 public:
  enum class Manner : std::uint8_t { recorded, walking, plain };
  static constexpr std::size_t manners = 3;
  // They stand by kind of task, generating first, and manner: samples or rays, and seconds.
  using Sums = std::array<double, 4 * manners>;

  // It records one of so many tasks, lets one walk, and has the others traced as without a profile.
  explicit Profiling(std::size_t domains, std::uint64_t turns = manners)
      : traffic(domains), of_turns_(turns) {}

  // Returns how the next task of this kind is traced.
  Manner next(Scheduler::Work work) {
    const std::uint64_t turn = turns_[index(work)]++ % of_turns_;
    return turn < manners ? static_cast<Manner>(turn) : Manner::plain;
  }
  // Notes that a task with so many samples, or rays, took so many seconds of the processor.
  void took(Scheduler::Work work, Manner manner, std::uint64_t rays, double seconds) {
    const std::size_t at = 2 * (manners * index(work) + static_cast<std::size_t>(manner));
    sums[at] += static_cast<double>(rays);
    sums[at + 1] += seconds;
  }

  // Returns the seconds that all tasks took.
  double all_s() const {
    double all_s = 0;
    for (std::size_t i = 1; i < sums.size(); i += 2) all_s += sums[i];
    return all_s;
  }
  // Returns the seconds that all tasks together would take, traced in this manner, or as those recorded where
  // none was.
  static double seconds_of_all(const Sums& sums, Manner manner) {
    double all_s = 0;
    for (std::size_t work = 0; work < 2; ++work) {
      const double* const first = &sums[2 * manners * work];
      double rays = 0;
      for (std::size_t m = 0; m < manners; ++m) rays += first[2 * m];
      const double* const own = first + 2 * static_cast<std::size_t>(manner);
      const double* const of = own[0] > 0 ? own : first;
      if (of[0] > 0) all_s += rays * of[1] / of[0];
    }
    return all_s;
  }
  // Returns how many times as many samples there are as were recorded.
  static double samples_a_recorded_one(const Sums& sums) {
    return sums[0] > 0 ? (sums[0] + sums[2] + sums[4]) / sums[0] : 1;
  }

  RayTraffic traffic;  // of what was recorded
  Sums sums{};

 private:
  static std::size_t index(Scheduler::Work work) { return work == Scheduler::Work::trace; }

  std::uint64_t of_turns_;
  std::array<std::uint64_t, 2> turns_{};
};

}  // namespace vitrail
