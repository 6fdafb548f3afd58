// SPDX-License-Identifier: Apache-2.0
#include "measure/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>

namespace vitrail {

namespace {

// What is known best of a setting: it was measured last. Null where it was not.
const MeasuredSetting* found(const Measurement& m, const Setting& setting) {
  const auto at = std::find_if(m.settings.rbegin(), m.settings.rend(),
                               [&](const MeasuredSetting& s) { return s.setting == setting; });
  return at == m.settings.rend() ? nullptr : &*at;
}

// A bias that was not seen may still be as great as its interval. It has to be small beside the error that is
// promised, else more samples are taken, up to a limit.
bool is_too_uncertain(const MeasuredSetting& s, int first_spp, double error) {
  constexpr double share = 0.3;
  return s.error.bias.half_width > share * error && s.spp < most_samples_factor * first_spp;
}

constexpr int most_measured = 12;  // for a goal

bool is_useful(const MeasuredSetting& s) { return s.failure.empty() && !s.identical; }

// Every combination of useful choices of axes that change the picture.
std::vector<Setting> combinations(const Measurement& m) {
  std::vector<Setting> all{Setting(m.axes.size(), 0)};
  for (std::size_t axis = 0; axis < m.axes.size(); ++axis) {
    if (m.axes[axis].same_picture) continue;
    std::vector<Setting> more;
    for (std::size_t choice = 1; choice < m.axes[axis].choices.size(); ++choice) {
      Setting alone(m.axes.size(), 0);
      alone[axis] = choice;
      const MeasuredSetting* s = found(m, alone);
      if (!s || !is_useful(*s)) continue;
      for (Setting changed : all) {
        changed[axis] = choice;
        more.push_back(changed);
      }
    }
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

Tradeoff guessed(const Measurement& m, const Setting& setting) {
  std::vector<Tradeoff> changes;
  for (std::size_t axis = 0; axis < setting.size(); ++axis) {
    if (setting[axis] == 0) continue;
    Setting alone(setting.size(), 0);
    alone[axis] = setting[axis];
    changes.push_back(found(m, alone)->tradeoff());
  }
  return combined(m.settings[0].tradeoff(), changes);
}

// Of the whole picture: a sample of every pixel takes as much longer as there are more pixels.
Tradeoff whole_picture(const Measurement& m, Tradeoff t) {
  t.sample_s *= m.full_size;
  return t;
}

void search(Measurement& m, Session& session, Recommendation& r) {
  const std::vector<Setting> settings = combinations(m);
  for (int tried = 0; tried <= most_measured; ++tried) {
    std::vector<Tradeoff> tradeoffs;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const MeasuredSetting* s = found(m, settings[i]);
      if (s ? !s->failure.empty() : tried == most_measured) continue;
      tradeoffs.push_back(whole_picture(m, s ? s->tradeoff() : guessed(m, settings[i])));
      of.push_back(i);
    }
    const std::optional<Prediction> p = best(tradeoffs, m.law, r.asked);
    if (!p) return;
    const Setting& setting = settings[of[p->index]];
    const int first_spp = m.settings[0].spp;
    const MeasuredSetting* s = found(m, setting);
    if (s && is_too_uncertain(*s, first_spp, p->error) && tried < most_measured) {
      m.settings.push_back(session.measure_setting(m, setting, 4 * s->spp));
      continue;
    }
    if (s) {
      r.found = true;
      r.name = s->name;
      r.render = render_arguments(m.axes, setting);
      r.partition = partition_arguments(m.axes, setting);
      r.bias = s->tradeoff().bias, r.bias_within = s->error.bias.half_width, r.luminance = s->error.luminance;
      r.spp = p->spp, r.error = p->error, r.cpu_s = p->cpu_s;
      r.wall_s = p->cpu_s / session.parallelism();
      return;
    }
    m.settings.push_back(session.measure_setting(m, setting, first_spp));
  }
}

}  // namespace

int most_searched(const MeasureOptions& o) {
  const int asked = (o.error ? 1 : 0) + (o.seconds ? 1 : 0);
  if (asked > 0) return asked * most_measured;
  const int of_own = std::bit_width(static_cast<unsigned>(most_samples_factor)) / 2;  // 4 and 16 times
  return 2 * most_measured + of_own;
}

void recommend(Measurement& m, Session& session, const MeasureOptions& o) {
  const Setting own_setting(m.axes.size(), 0);
  std::vector<Recommendation>& all = m.recommendations;
  if (o.error) all.push_back({fmt::format("a relMSE of {:.3g}", *o.error), {o.error, {}}});
  if (o.seconds)
    all.push_back(
        {fmt::format("{:.3g} s on this machine", *o.seconds), {{}, *o.seconds * session.parallelism()}});
  if (all.empty()) {
    const int spp = m.scene_spp;
    const auto own = [&] { return whole_picture(m, found(m, own_setting)->tradeoff()); };
    while (is_too_uncertain(*found(m, own_setting), m.settings[0].spp, predicted_error(own(), m.law, spp)))
      m.settings.push_back(session.measure_setting(m, own_setting, 4 * found(m, own_setting)->spp));
    all.push_back({fmt::format("the error of the scene's own setting at its {} samples", spp),
                   {predicted_error(own(), m.law, spp), {}}});
    all.push_back({fmt::format("the time of the scene's own setting at its {} samples", spp),
                   {{}, predicted_cpu_s(own(), m.law, spp)}});
  }
  if (o.every_combination)
    for (const Setting& setting : combinations(m))
      if (!found(m, setting)) m.settings.push_back(session.measure_setting(m, setting, m.settings[0].spp));
  for (Recommendation& r : all) search(m, session, r);
}

}  // namespace vitrail
