// SPDX-License-Identifier: Apache-2.0
#include "measure/plan.h"

#include <algorithm>

#include "measure/recommend.h"

namespace vitrail {

// A reference of 16 times the samples of a picture leaves what bias is found ten times as far above its noise
// as above that of the mean of six pictures.
Plan make_plan(const MeasureOptions& o, const std::vector<Axis>& axes, double sample_wall_s,
               double start_wall_s) {
  constexpr int reference_factor = 16, short_search = 3;
  int settings = 1, combinations = 1, once = 0;
  std::vector<int> least;  // of each choice, whatever the samples of the others
  for (const Axis& axis : axes) {
    const int choices = static_cast<int>(axis.choices.size());
    const bool same_picture = axis.effect == Effect::nothing;
    (same_picture ? once : settings) += choices - 1;
    if (!same_picture) combinations *= choices;
    for (const Choice& choice : axis.choices) least.push_back(choice.least_spp);
  }
  if (o.every_combination) settings = combinations;
  Plan plan;
  // With the pictures that biases are differences to, at as many counts of samples.
  plan.renders = o.seeds * (settings + 2 + 3) + once + 2;
  plan.search_renders = o.seeds * most_searched(o);
  // The samples' axis: a quarter and four times as many. What biases are differences to is the choice of all
  // depths, where depth is an axis.
  const double whole = std::ranges::find(axes, "depth", &Axis::name) == axes.end() ? 1 : 0;
  const double pictures = o.seeds * (settings + 2 * (0.25 + 4) + whole) + once,
               searched = o.seeds * short_search;
  const double fixed_s = plan.renders * start_wall_s;
  const double left_s = o.budget_s - fixed_s - searched * start_wall_s;
  const double per_sample_s = sample_wall_s * (pictures + searched + 2 * reference_factor);
  const auto beyond_s = [&](int spp) {
    double samples = 0;
    for (const int n : least) samples += o.seeds * std::max(0, n - spp);
    return samples * sample_wall_s;
  };
  plan.spp = o.spp;
  if (o.spp == 0)
    for (plan.spp = 64; plan.spp > 4 && per_sample_s * plan.spp + beyond_s(plan.spp) > left_s;) plan.spp /= 2;
  plan.reference_spp = o.reference_spp > 0 ? o.reference_spp : reference_factor * plan.spp;
  plan.wall_s = fixed_s + sample_wall_s * (pictures * plan.spp + 2 * plan.reference_spp) + beyond_s(plan.spp);
  return plan;
}

}  // namespace vitrail
