// SPDX-License-Identifier: Apache-2.0
#include "measure/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <map>
#include <span>

namespace vitrail {

namespace {

// What is known best of a setting: it was measured last. Null where it was not.
const MeasuredSetting* found(const Measurement& m, const Setting& setting) {
  const auto at = std::find_if(m.settings.rbegin(), m.settings.rend(),
                               [&](const MeasuredSetting& s) { return s.setting == setting; });
  return at == m.settings.rend() ? nullptr : &*at;
}

// What is known best of the biases: they depend on the axes that have one, whatever the others are.
class Biases {
 public:
  explicit Biases(const Measurement& m) : axes_(m.axes) {
    for (const MeasuredSetting& s : m.settings) {
      if (!s.failure.empty()) continue;
      const auto [known, is_new] = best_.try_emplace(part(s.setting), &s);
      if (!is_new && s.error.bias.half_width < known->second->error.bias.half_width) known->second = &s;
    }
  }
  // Null where none was measured.
  const MeasuredSetting* of(const Setting& setting) const {
    const auto known = best_.find(part(setting));
    return known == best_.end() ? nullptr : known->second;
  }
  Tradeoff with(Tradeoff t, const Setting& setting) const {
    if (const MeasuredSetting* s = of(setting)) t.bias = s->tradeoff().bias;
    return t;
  }

 private:
  Setting part(Setting setting) const {
    for (std::size_t i = 0; i < setting.size(); ++i)
      if (axes_[i].effect != Effect::bias) setting[i] = 0;
    return setting;
  }
  const std::vector<Axis>& axes_;
  std::map<Setting, const MeasuredSetting*> best_;
};

// A bias that was not seen may still be as great as its interval. It has to be small beside the error that is
// promised, else more samples are taken, up to a limit.
bool is_too_uncertain(const Estimate& bias, const MeasuredSetting& s, int first_spp, double error) {
  constexpr double share = 0.3;
  return bias.half_width > share * error && s.spp < most_samples_factor * std::max(first_spp, s.least_spp);
}

constexpr int most_measured = 12;  // for a goal

bool is_useful(const MeasuredSetting& s) { return s.failure.empty() && !s.identical; }

struct Candidate {
  Setting setting;
  Tradeoff guess;  // from its changes alone
};

struct Change {
  std::size_t choice = 0;
  Tradeoff tradeoff;
  double noise = 0;  // over the scene's own at as many samples
};

// In nothing better, in something worse, or the same but later.
bool is_beaten(const Change& c, const Change& by) {
  return by.noise <= c.noise && by.tradeoff.sample_s <= c.tradeoff.sample_s &&
         by.tradeoff.bias <= c.tradeoff.bias && by.tradeoff.least_spp <= c.tradeoff.least_spp &&
         (by.noise < c.noise || by.tradeoff.sample_s < c.tradeoff.sample_s ||
          by.tradeoff.bias < c.tradeoff.bias || by.choice < c.choice);
}

// Of each axis that changes the picture, the scene's own and what is useful; where `promising`, only what no
// other of the axis beats in all, as no guess with it is then the best.
std::vector<std::vector<Change>> useful_changes(const Measurement& m, bool promising) {
  const Tradeoff own = m.settings[0].tradeoff();
  std::vector<std::vector<Change>> all(m.axes.size());
  for (std::size_t axis = 0; axis < m.axes.size(); ++axis) {
    std::vector<Change> changes{{0, own, 1}};
    for (std::size_t choice = 1; choice < m.axes[axis].choices.size(); ++choice) {
      Setting alone(m.axes.size(), 0);
      alone[axis] = choice;
      const MeasuredSetting* s = found(m, alone);
      if (m.axes[axis].effect == Effect::nothing || !s || !is_useful(*s)) continue;
      const double noise = predicted_error({own.noise, 0, own.spp}, m.law, s->spp);
      changes.push_back({choice, s->tradeoff(), noise > 0 ? s->tradeoff().noise / noise : 1});
    }
    // Nothing else than the scene's own is sure to have no bias that was not seen.
    const auto sure = m.axes[axis].effect == Effect::bias ? std::span(changes).first(1) : std::span(changes);
    for (const Change& c : changes) {
      const bool beaten = std::ranges::any_of(sure, [&](const Change& by) { return is_beaten(c, by); });
      if (!promising || !beaten) all[axis].push_back(c);
    }
  }
  return all;
}

std::vector<Candidate> combinations(const Measurement& m, bool promising) {
  const std::vector<std::vector<Change>> axes = useful_changes(m, promising);
  const Tradeoff own = m.settings[0].tradeoff();
  std::vector<Candidate> all;
  Setting setting(m.axes.size(), 0);
  std::vector<Tradeoff> changes;
  const auto choose = [&](const auto& self, std::size_t axis) -> void {
    if (axis == axes.size()) {
      all.push_back({setting, combined(own, changes, m.law)});
      return;
    }
    for (const Change& c : axes[axis]) {
      setting[axis] = c.choice;
      if (c.choice > 0) changes.push_back(c.tradeoff);
      self(self, axis + 1);
      if (c.choice > 0) changes.pop_back();
    }
  };
  choose(choose, 0);
  return all;
}

// Of the whole picture: a sample of every pixel takes as much longer as there are more pixels.
Tradeoff whole_picture(const Measurement& m, Tradeoff t) {
  t.sample_s *= m.full_size;
  return t;
}

void search(Measurement& m, Session& session, Recommendation& r) {
  const std::vector<Candidate> candidates = combinations(m, true);
  for (int tried = 0; tried <= most_measured; ++tried) {
    std::vector<Tradeoff> tradeoffs;
    std::vector<const Candidate*> of;
    const Biases biases(m);
    std::map<Setting, const MeasuredSetting*> measured;  // the last of each
    for (const MeasuredSetting& s : m.settings) measured[s.setting] = &s;
    for (const Candidate& c : candidates) {
      const auto known = measured.find(c.setting);
      const MeasuredSetting* s = known == measured.end() ? nullptr : known->second;
      if (s ? !s->failure.empty() : tried == most_measured) continue;
      tradeoffs.push_back(whole_picture(m, biases.with(s ? s->tradeoff() : c.guess, c.setting)));
      of.push_back(&c);
    }
    const std::optional<Prediction> p = best(tradeoffs, m.law, r.asked);
    if (!p) return;
    const Setting& setting = of[p->index]->setting;
    const int first_spp = m.settings[0].spp;
    const MeasuredSetting* s = found(m, setting);
    if (s && is_too_uncertain(biases.of(setting)->error.bias, *s, first_spp, p->error) &&
        tried < most_measured) {
      m.settings.push_back(session.measure_setting(m, setting, 4 * s->spp));
      continue;
    }
    if (s) {
      r.found = true;
      r.name = s->name;
      r.render = render_arguments(m.axes, setting);
      r.partition = partition_arguments(m.axes, setting);
      const MeasuredSetting& biased = *biases.of(setting);
      r.bias = biased.tradeoff().bias, r.bias_within = biased.error.bias.half_width;
      r.luminance = biased.error.luminance;
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
    const auto is_unsure = [&] {
      const MeasuredSetting& s = *found(m, own_setting);
      return is_too_uncertain(s.error.bias, s, m.settings[0].spp, predicted_error(own(), m.law, spp));
    };
    while (is_unsure())
      m.settings.push_back(session.measure_setting(m, own_setting, 4 * found(m, own_setting)->spp));
    all.push_back({fmt::format("the error of the scene's own setting at its {} samples", spp),
                   {predicted_error(own(), m.law, spp), {}}});
    all.push_back({fmt::format("the time of the scene's own setting at its {} samples", spp),
                   {{}, predicted_cpu_s(own(), m.law, spp)}});
  }
  if (o.every_combination)
    for (const auto& [setting, guess] : combinations(m, false))
      if (!found(m, setting)) m.settings.push_back(session.measure_setting(m, setting, m.settings[0].spp));
  for (Recommendation& r : all) search(m, session, r);
}

}  // namespace vitrail
