// SPDX-License-Identifier: Apache-2.0
// What a render is to reach, and the rounds of samples in which it gets there. After a round no ray is alive
// and the film is whole on rank 0: what comes next follows from it alone, so it is the same on any number of
// ranks, and after any number of kills.
#pragma once

#include <optional>
#include <vector>

#include "farm/plan/options.h"
#include "farm/plan/work.h"
#include "farm/transport/transport.h"
#include "film/film_noise.h"

namespace vitrail {

struct Goal {
  std::uint32_t samples = 0;  // a pixel at most, on the average
  bool in_rounds = false;     // else all samples are one
  bool adaptive = false;
  bool one_by_one = false;  // a sample of all pixels is an iteration of photon mapping
  bool open_ended = false;  // `samples` is only what nobody wants more than
  std::optional<TargetError> target;
  std::uint32_t first_samples(std::uint32_t pixels) const;  // a pixel, of the first round
};

// Where neither the number of samples nor the scene's counts: with --target-error and --time.
inline constexpr int most_samples_unasked = 65536;
inline constexpr int most_iterations_unasked = 4096;  // of photon mapping

// `scene`: its settings, with the integrator that the options choose.
Goal goal_of(const RenderOptions& options, const RenderSettings& scene);

// What the film's error is in the unit of the target: relMSE, or just noticeable differences.
struct ReachedError {
  double estimate = 0;
  double upper = 0;  // the true error is below in most pictures, see film/film_noise.h
};
ReachedError reached_error(const Film& film, const TargetError& target);

// Uniform, until every pixel has `samples`; or `more` of each pixel.
struct NextRound {
  std::uint32_t samples = 0;
  std::vector<std::uint32_t> more;  // empty: uniform
};

// Of a film between two rounds. Empty: the goal is reached, or has no rounds.
std::optional<NextRound> next_round(const Film& film, const Goal& goal);

// How many samples a pixel the goal will take, by what is known so far.
double expected_samples(const Film& film, const Goal& goal);

// The work of a round that follows `plan`. To be called by all ranks together; `next` and `film` are rank
// 0's. Empty: there is none.
std::optional<WorkPlan> agree_on_round(Transport& transport, std::optional<NextRound> next, const Film& film,
                                       const WorkPlan& plan);

}  // namespace vitrail
