// SPDX-License-Identifier: Apache-2.0
#include "measure/plan.h"

#include <algorithm>
#include <bit>

#include "measure/recommend.h"

namespace vitrail {

namespace {

int power_of_two_below(double v) {
  return v < 2 ? 1 : static_cast<int>(std::bit_floor(static_cast<unsigned>(std::min(v, 65536.0))));
}

}  // namespace

// A reference of 16 times the samples of a picture leaves what bias is found ten times as far above its noise
// as above that of the mean of six pictures.
Plan make_plan(const MeasureOptions& o, const std::vector<Axis>& axes, double sample_wall_s,
               double start_wall_s) {
  constexpr int reference_factor = 16, short_search = 3;
  int settings = 1, combinations = 1, once = 0;
  for (const Axis& axis : axes) {
    const int choices = static_cast<int>(axis.choices.size());
    (axis.same_picture ? once : settings) += choices - 1;
    if (!axis.same_picture) combinations *= choices;
  }
  if (o.every_combination) settings = combinations;
  Plan plan;
  plan.renders = o.seeds * (settings + 2) + once + 2;
  plan.search_renders = o.seeds * most_searched(o);
  // The samples' axis: a quarter and four times as many.
  const double pictures = o.seeds * (settings + 0.25 + 4) + once, searched = o.seeds * short_search;
  const double fixed_s = plan.renders * start_wall_s;
  const double left_s = o.budget_s - fixed_s - searched * start_wall_s;
  const double per_sample_s = sample_wall_s * (pictures + searched + 2 * reference_factor);
  plan.spp = o.spp > 0 ? o.spp : std::clamp(power_of_two_below(left_s / per_sample_s), 4, 64);
  plan.reference_spp = o.reference_spp > 0 ? o.reference_spp : reference_factor * plan.spp;
  plan.wall_s = fixed_s + sample_wall_s * (pictures * plan.spp + 2 * plan.reference_spp);
  return plan;
}

}  // namespace vitrail
