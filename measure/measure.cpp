// SPDX-License-Identifier: Apache-2.0
#include "measure/measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "measure/plan.h"
#include "measure/recommend.h"
#include "measure/session.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

Tradeoff MeasuredSetting::tradeoff() const {
  return {std::max(error.noise.value, 0.0), expected_bias(error.bias), spp, sample_s, least_spp};
}

std::ptrdiff_t MeasuredSetting::changes() const {
  return std::ranges::count_if(setting, [](std::size_t choice) { return choice > 0; });
}

namespace {

// What each setting would take on the cluster, and what is recommended.
void plan_farm(Measurement& m, Session& session, const MeasureOptions& options) {
  if (options.farm.ranks == 0) return;
  for (MeasuredSetting& s : m.settings) {
    if (!s.failure.empty() || s.again) continue;
    try {
      s.farm = session.plan_farm(m, s);
    } catch (const MachineError&) {  // plan needs more memory than render for a picture as small as these
      if (!limits_memory(m.axes, s.setting)) throw;
    }
  }
  for (Recommendation& r : m.recommendations) {
    const auto s = std::ranges::find(m.settings, r.name, &MeasuredSetting::name);
    if (r.found && s->farm.is_known()) r.farm_s = s->farm(r.spp);
  }
}

}  // namespace

Measurement measure(const MeasureOptions& options, const Execute& execute, const MeasureNews& news) {
  Runs runs(options.scene, options.folder, options.width, execute);
  Measurement m;
  m.axes = chosen_axes(known_axes({}), options.axes);

  constexpr int timing_spp = 4;
  // With profiles, as they may be asked for again.
  const bool profile = options.farm.ranks > 0;
  const RunResult start = runs({{}, {}, 1, 1, profile}), timed = runs({{}, {}, timing_spp, 1, profile});
  const double sample_wall_s = std::max(1e-4, (timed.wall_s - start.wall_s) / (timing_spp - 1));
  m.law.start_s = std::max(0.0, start.cpu_s - (timed.cpu_s - start.cpu_s) / (timing_spp - 1));
  m.full_size = runs.full_size_ratio();
  m.scene_spp = runs.scene_spp();
  m.farm = options.farm;
  m.most_bias = options.most_bias;
  const Plan plan =
      make_plan(options, m.axes, sample_wall_s, std::max(0.0, start.wall_s - sample_wall_s) + 0.2);
  news.say(fmt::format(
      "{} × {} pixels, {} samples, {} seeds a setting, a reference of 2 × {}: {} renders, about "
      "{:.0f} s. The search for a recommendation then takes up to {} more renders, some of up to {} "
      "times the samples. Pictures in the folder are not rendered again",
      timed.picture.width, timed.picture.height, plan.spp, options.seeds, plan.reference_spp, plan.renders,
      plan.wall_s, plan.search_renders, most_samples_factor));

  Session session(runs, options, plan.spp, plan.renders + plan.search_renders, news);
  m.reference_spp = plan.reference_spp;
  m.reference = session.reference(plan.reference_spp);
  m.axes = chosen_axes(known_axes({m.reference.mean_luminance, runs.scene_is_direct()}), options.axes);
  session.measure_axes(m);
  session.measure_samples(m);
  recommend(m, session, options);
  plan_farm(m, session, options);
  m.parallelism = session.parallelism();
  return m;
}

}  // namespace vitrail
