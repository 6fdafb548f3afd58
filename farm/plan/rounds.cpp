// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/rounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "film/sample_map.h"

namespace vitrail {

namespace {

// Enough for a first estimate of an error; the first round of a picture that is to be there at a certain time
// is as short as it can be.
constexpr std::uint32_t pilot_samples = 16, quickest_samples = 2;
// A round's samples over those before it. The error is foreseen to fall as one over the samples; a little
// more than that spares another round.
constexpr double least_growth = 1.25, growth = 2, foresight = 1.1;
// Of the round that makes a picture adaptive: every pixel has its least share by then.
constexpr double first_growth = 4;

double samples_of_a_pixel(const Film& film) {
  return static_cast<double>(film.samples()) / static_cast<double>(film.pixels());
}

std::uint32_t even_above(double samples) { return 2 * static_cast<std::uint32_t>(std::ceil(samples / 2)); }

}  // namespace

Goal goal_of(const RenderOptions& o, const RenderSettings& scene) {
  Goal goal;
  goal.adaptive = o.picture.adaptive;
  goal.target = o.picture.target_error;
  // With a time limit the picture is to be whole early on, and then better and better.
  const bool limited = o.resources.time_limit_s > 0 && !o.outputs.dry_run,
             as_long_as_it_takes = o.picture.target_error || limited;
  goal.one_by_one = scene.photons.has_value();
  goal.in_rounds = !o.outputs.dry_run && !scene.photons && (o.picture.adaptive || as_long_as_it_takes);
  goal.open_ended = as_long_as_it_takes && !o.picture.samples_per_pixel;
  goal.samples = static_cast<std::uint32_t>(o.picture.samples_per_pixel ? *o.picture.samples_per_pixel
                                            : as_long_as_it_takes ? scene.photons ? most_iterations_unasked
                                                                                  : most_samples_unasked
                                                                  : scene.samples_per_pixel);
  return goal;
}

std::uint32_t Goal::first_samples(std::uint32_t pixels) const {
  if (!in_rounds) return samples;
  const std::uint32_t quarter = std::max(quickest_samples, std::bit_floor(samples / 4));
  const std::uint32_t estimated =
      std::max(pilot_samples, even_above(static_cast<double>(least_samples_of_estimate) / pixels));
  const std::uint32_t first = target       ? estimated
                              : !adaptive  ? quickest_samples
                              : open_ended ? pilot_samples
                                           : quarter;
  return std::min(first, samples);
}

ReachedError reached_error(const Film& film, const TargetError& target) {
  if (!target.just_noticeable) {
    const NoiseEstimate noise = relative_squared_error(film);
    return {noise.mean, noise.upper()};
  }
  const NoiseEstimate noise = displayed_squared_error(film);
  return {std::sqrt(noise.mean), std::sqrt(noise.upper())};
}

namespace {

// The upper bound of the error over the target, as a ratio of squared errors; above 1: not reached.
double excess(const Film& film, const TargetError& target) {
  const double ratio = reached_error(film, target).upper / target.value;
  return target.just_noticeable ? ratio * ratio : ratio;
}

}  // namespace

std::optional<NextRound> next_round(const Film& film, const Goal& goal) {
  if (!goal.in_rounds) return std::nullopt;
  const double held = samples_of_a_pixel(film);
  const bool even = is_even(film);
  double factor = !goal.adaptive || !even          ? growth
                  : goal.target || goal.open_ended ? first_growth
                                                   : goal.samples / held;
  bool adaptive = goal.adaptive;
  if (goal.target) {
    const double least = goal.first_samples(film.pixels());
    const double over = held < least ? least / held : excess(film, *goal.target);
    if (over <= 1) return std::nullopt;
    // Near its end a picture does not become adaptive any more.
    if (even && over < first_growth) adaptive = false;
    if (!adaptive || !even) factor = std::clamp(foresight * over, least_growth, growth);
  }
  const double wanted = std::min(held * factor, static_cast<double>(goal.samples));
  if (adaptive) {
    const double more = wanted - held;
    if (more < 2) return std::nullopt;  // no pixel has an odd number
    NextRound next{0, more_samples(film, static_cast<std::uint64_t>(more * film.pixels()))};
    // What is left may be less than the step of any pixel that comes first.
    if (std::ranges::all_of(next.more, [](std::uint32_t n) { return n == 0; })) return std::nullopt;
    return next;
  }
  const std::uint32_t end = std::min(even_above(wanted), goal.samples);
  if (end <= held) return std::nullopt;
  if (!goal.adaptive) return NextRound{end, {}};
  return NextRound{0, std::vector<std::uint32_t>(film.pixels(), end - static_cast<std::uint32_t>(held))};
}

double expected_samples(const Film& film, const Goal& goal) {
  if (!goal.target || film.samples() == 0) return goal.samples;
  return std::min<double>(goal.samples, samples_of_a_pixel(film) * std::max(1.0, excess(film, *goal.target)));
}

std::optional<WorkPlan> agree_on_round(Transport& transport, std::optional<NextRound> next, const Film& film,
                                       const WorkPlan& plan) {
  std::array<std::uint64_t, 3> told{};
  if (next) told = {1, next->samples, !next->more.empty()};
  transport.broadcast_from_root(told);
  if (told[0] == 0) return std::nullopt;
  if (told[2] == 0) {
    std::vector<std::uint32_t> ends;
    for (const WorkPlan::Part& part : plan.parts) ends.push_back(part.end);
    return make_work_plan(plan.crop, static_cast<std::uint32_t>(told[1]), ends);
  }
  std::vector<std::uint32_t> held(film.pixels()), more(next ? 0 : film.pixels());
  if (next) {
    for (std::uint32_t p = 0; p < film.pixels(); ++p) held[p] = static_cast<std::uint32_t>(film.samples(p));
    more = std::move(next->more);
  }
  transport.broadcast_from_root(std::span(held));
  transport.broadcast_from_root(std::span(more));
  return make_adaptive_round(plan.crop, std::move(held), std::move(more));
}

}  // namespace vitrail
