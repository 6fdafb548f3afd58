// SPDX-License-Identifier: Apache-2.0
#include "measure/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "measure/recommend.h"
#include "measure/session.h"
#include "scene/diagnostics.h"

namespace vitrail {

Tradeoff MeasuredSetting::tradeoff() const {
  return {std::max(error.noise.value, 0.0), error.is_biased() ? error.bias.value : 0, spp, sample_s};
}

namespace {

int power_of_two_below(double v) {
  return v < 2 ? 1 : static_cast<int>(std::bit_floor(static_cast<unsigned>(std::min(v, 65536.0))));
}

struct Plan {
  int spp, reference_spp, renders;
  double wall_s;
};

// A reference of 16 times the samples of a picture leaves what bias is found ten times as far above its noise
// as above that of the mean of six pictures.
Plan make_plan(const MeasureOptions& o, const std::vector<Axis>& axes, double sample_wall_s,
               double start_wall_s) {
  constexpr int reference_factor = 16, searched = 3;
  int settings = 1 + searched, once = 0;
  for (const Axis& axis : axes)
    (axis.same_picture ? once : settings) += static_cast<int>(axis.choices.size()) - 1;
  // The samples' axis: a quarter and four times as many.
  const double pictures = o.seeds * (settings + 0.25 + 4) + once;
  const int renders = o.seeds * (settings + 2) + once + 2;
  const double per_sample = sample_wall_s * (pictures + 2 * reference_factor), fixed = renders * start_wall_s;
  const int spp =
      o.spp > 0 ? o.spp : std::clamp(power_of_two_below((o.budget_s - fixed) / per_sample), 4, 64);
  const int reference_spp = o.reference_spp > 0 ? o.reference_spp : reference_factor * spp;
  return {spp, reference_spp, renders, fixed + sample_wall_s * (pictures * spp + 2 * reference_spp)};
}

}  // namespace

Measurement measure(const MeasureOptions& options, const Execute& execute, const MeasureNews& news) {
  Runs runs(options.scene, options.folder, options.width, execute);
  Measurement m;
  m.axes = chosen_axes(known_axes({}), options.axes);

  constexpr int timing_spp = 4;
  const RunResult start = runs({{}, {}, 1, 1}), timed = runs({{}, {}, timing_spp, 1});
  const double sample_wall_s = std::max(1e-4, (timed.wall_s - start.wall_s) / (timing_spp - 1));
  m.law.start_s = std::max(0.0, start.cpu_s - (timed.cpu_s - start.cpu_s) / (timing_spp - 1));
  m.full_size = runs.full_size_ratio();
  m.scene_spp = runs.scene_spp();
  const Plan plan =
      make_plan(options, m.axes, sample_wall_s, std::max(0.0, start.wall_s - sample_wall_s) + 0.2);
  news.say(
      fmt::format("{} × {} pixels, {} samples, {} seeds a setting, a reference of 2 × {}: at most {} "
                  "renders, about {:.0f} s "
                  "(what is there already is not rendered again)",
                  timed.picture.width, timed.picture.height, plan.spp, options.seeds, plan.reference_spp,
                  plan.renders, plan.wall_s));

  Session session(runs, options, plan.spp, plan.renders, news);
  m.reference_spp = plan.reference_spp;
  m.reference = session.reference(plan.reference_spp);
  m.axes = chosen_axes(known_axes({m.reference.mean_luminance}), options.axes);
  session.measure_axes(m);
  session.measure_samples(m);
  recommend(m, session, options);
  m.parallelism = session.parallelism();
  return m;
}

}  // namespace vitrail
