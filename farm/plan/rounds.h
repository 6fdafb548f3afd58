// SPDX-License-Identifier: Apache-2.0
// A render reaches its goal in rounds of samples. After a round no ray is alive and the film is whole on rank
// 0. The next round follows from that film alone, so it is the same on any number of ranks, and after any
// number of kills.
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

// They bound the samples where --target-error or --time is given and no number of samples; the scene's number
// does not count then.
inline constexpr int most_samples_unasked = 65536;
inline constexpr int most_iterations_unasked = 4096;  // of photon mapping

// Returns the goal. `scene` holds its settings, with the integrator that the options choose.
Goal goal_of(const RenderOptions& options, const RenderSettings& scene);

// It is the film's error in the unit of the target: relMSE, or just noticeable differences.
struct ReachedError {
  double estimate = 0;
  double upper = 0;  // the true error is below in most pictures, see film/film_noise.h
};
ReachedError reached_error(const Film& film, const TargetError& target);

// It is uniform, until every pixel has `samples`; or it has `more` of each pixel.
struct NextRound {
  std::uint32_t samples = 0;
  std::vector<std::uint32_t> more;  // empty: uniform
};

// Returns the round that follows a film between two rounds; nothing where the goal is reached, or has no
// rounds.
std::optional<NextRound> next_round(const Film& film, const Goal& goal);

// Returns how many samples a pixel the goal will take, by what is known so far.
double expected_samples(const Film& film, const Goal& goal);

// Returns the work of a round that follows `plan`; nothing where there is none. All ranks call it together;
// `next` and `film` are rank 0's.
std::optional<WorkPlan> agree_on_round(Transport& transport, std::optional<NextRound> next, const Film& film,
                                       const WorkPlan& plan);

}  // namespace vitrail
