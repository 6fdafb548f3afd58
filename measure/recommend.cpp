// SPDX-License-Identifier: Apache-2.0
#include "measure/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <span>

#include "measure/biases.h"

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
bool may_learn(const MeasuredSetting& s, int first_spp) {
  return s.spp < most_samples_factor * std::max(first_spp, s.least_spp);
}

bool is_too_uncertain(const Estimate& bias, const MeasuredSetting& s, int first_spp, double error) {
  constexpr double share = 0.3;
  return bias.half_width > share * error && may_learn(s, first_spp);
}

constexpr int most_measured = 12;  // for a goal
constexpr int most_checks = 4;     // of them, of settings that were measured at other samples

// With the slope of its own noise, where it was measured at several counts.
Tradeoff tradeoff_of(const Measurement& m, const MeasuredSetting& s) {
  Tradeoff t = s.tradeoff();
  std::vector<double> counts, noise;
  for (const MeasuredSetting& other : m.settings)
    if (other.setting == s.setting && other.error.noise.value > 0)
      counts.push_back(other.spp), noise.push_back(other.error.noise.value);
  if (counts.size() > 1 && std::ranges::max(counts) > std::ranges::min(counts))
    t.slope = fitted_slope(counts, noise);
  return t;
}

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
// other of the axis beats in all, as no guess with it is then the best, and whose light is not too far off.
std::vector<std::vector<Change>> useful_changes(const Measurement& m, bool promising, double most_bias) {
  const Tradeoff own = m.settings[0].tradeoff();
  const auto is_beyond = [&](const MeasuredSetting& s) {
    return promising && judge(s.error.luminance, most_bias) == LightVerdict::beyond;
  };
  std::vector<std::vector<Change>> all(m.axes.size());
  for (std::size_t axis = 0; axis < m.axes.size(); ++axis) {
    std::vector<Change> changes{{0, own, 1}};
    for (std::size_t choice = 1; choice < m.axes[axis].choices.size(); ++choice) {
      Setting alone(m.axes.size(), 0);
      alone[axis] = choice;
      const MeasuredSetting* s = found(m, alone);
      if (m.axes[axis].effect == Effect::nothing || !s || !is_useful(*s)) continue;
      if (m.axes[axis].effect == Effect::bias && is_beyond(*s)) continue;
      const double noise = predicted_error({own.noise, 0, own.spp}, m.law, s->spp);
      changes.push_back({choice, s->tradeoff(), noise > 0 ? s->tradeoff().noise / noise : 1});
    }
    // Nothing else than the scene's own is sure to have no bias that was not seen, and it may be out of
    // bounds.
    const auto sure = m.axes[axis].effect != Effect::bias
                          ? std::span(changes)
                          : std::span(changes).first(is_beyond(m.settings[0]) ? 0 : 1);
    for (const Change& c : changes) {
      const bool beaten = std::ranges::any_of(sure, [&](const Change& by) { return is_beaten(c, by); });
      if (!promising || !beaten) all[axis].push_back(c);
    }
  }
  return all;
}

std::vector<Candidate> combinations(const Measurement& m, bool promising, double most_bias) {
  const std::vector<std::vector<Change>> axes = useful_changes(m, promising, most_bias);
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

// Where its light is too far off, or may be and cannot be known better.
bool is_out_of_bounds(const Biases& biases, const Setting& setting, const MeasuredSetting* s, double most,
                      bool can_learn) {
  const MeasuredSetting* known = biases.light_of(setting);
  if (!known) return false;
  const LightVerdict light = judge(known->error.luminance, most);
  return light == LightVerdict::beyond || (light == LightVerdict::unsure && s && !can_learn);
}

// The counts at which it was rendered, if those will do instead of `wanted`: for an error, the least that
// have it; for a time, the most that fit.
bool serves(const MeasuredSetting& s, const Prediction& wanted, const MeasureGoal& goal) {
  if (s.spp == wanted.spp) return true;
  const double more = static_cast<double>(wanted.spp) / s.spp;
  if (more > most_unrendered_factor || more < 1 / most_unrendered_factor) return false;
  return goal.error ? s.error.relmse.value <= *goal.error : s.spp < wanted.spp;
}

double squared(double v) { return v * v; }

// What is promised of a setting that was rendered last with the samples that are recommended, or near them.
void promise(const Measurement& m, Recommendation& r, const MeasuredSetting& s, const Estimate& bias,
             double parallelism) {
  Tradeoff t = tradeoff_of(m, s);
  t.bias = expected_bias(bias);
  t = whole_picture(m, t);
  r.rendered_spp = s.spp;
  r.cpu_s = predicted_cpu_s(t, m.law, r.spp), r.wall_s = r.cpu_s / parallelism;
  if (r.spp == s.spp) {
    r.error = s.error.relmse.value, r.error_within = s.error.relmse.half_width;
    return;
  }
  constexpr double slope_within = 0.45;  // of those that there are, see fitted_slope
  r.error = predicted_error(t, m.law, r.spp);
  const double noise = r.error - t.bias, farther = std::log(static_cast<double>(r.spp) / s.spp),
               share = t.noise > 0 ? s.error.noise.half_width / t.noise : 0;
  r.error_within =
      std::sqrt(squared(share * noise) + squared(bias.half_width) + squared(slope_within * farther * noise));
}

struct Pick {
  Setting setting;
  Prediction prediction;
};

// Of what is measured, or else promises most.
std::optional<Pick> best_of(const Measurement& m, const std::vector<Candidate>& candidates, Recommendation& r,
                            bool measured_alone) {
  std::vector<Tradeoff> tradeoffs;
  std::vector<const Candidate*> of;
  const Biases biases(m);
  std::map<Setting, const MeasuredSetting*> measured;  // the last of each
  for (const MeasuredSetting& s : m.settings) measured[s.setting] = &s;
  for (const Candidate& c : candidates) {
    const auto known = measured.find(c.setting);
    const MeasuredSetting* s = known == measured.end() ? nullptr : known->second;
    if (s ? !s->failure.empty() : measured_alone) continue;
    const bool can_learn = s && !measured_alone && may_learn(*s, m.settings[0].spp);
    if (is_out_of_bounds(biases, c.setting, s, r.most_bias, can_learn)) {
      r.bound_counts = true;
      continue;
    }
    tradeoffs.push_back(whole_picture(m, biases.with(s ? tradeoff_of(m, *s) : c.guess, c.setting)));
    of.push_back(&c);
  }
  const std::optional<Prediction> p = best(tradeoffs, m.law, r.asked);
  if (!p) return std::nullopt;
  return Pick{of[p->index]->setting, *p};
}

// One of these a time, until what is best was rendered with its own samples.
void search(Measurement& m, Session& session, Recommendation& r) {
  const std::vector<Candidate> candidates = combinations(m, true, r.most_bias);
  const int first_spp = m.settings[0].spp;
  int checks = 0;
  for (int tried = 0; tried <= most_measured; ++tried) {
    const bool last = tried == most_measured;
    const std::optional<Pick> pick = best_of(m, candidates, r, last);
    if (!pick) return;
    const auto& [setting, p] = *pick;
    const MeasuredSetting* s = found(m, setting);
    if (!s) {
      m.settings.push_back(session.measure_setting(m, setting, first_spp));
      continue;
    }
    const Biases biases(m);
    const Estimate bias = biases.of(setting)->error.bias,
                   luminance = biases.light_of(setting)->error.luminance;
    const bool unsure = is_too_uncertain(bias, *s, first_spp, p.error) ||
                        (judge(luminance, r.most_bias) == LightVerdict::unsure && may_learn(*s, first_spp));
    if (unsure && !last) {
      m.settings.push_back(session.measure_setting(m, setting, 4 * s->spp));
      continue;
    }
    const bool served = serves(*s, p, r.asked);
    const int checkable = session.checkable(*s, p.spp);
    const bool nearer = checkable == p.spp || (s->spp < checkable && checkable < p.spp);
    if (!served && !last && checks < most_checks && nearer) {
      ++checks;
      m.settings.push_back(session.check(m, *s, checkable));
      continue;
    }
    r.found = true;
    r.name = s->name;
    r.render = render_arguments(m.axes, setting);
    r.partition = partition_arguments(m.axes, setting);
    r.bias = expected_bias(bias), r.bias_within = bias.half_width;
    r.luminance = luminance;
    r.spp = served ? s->spp : p.spp;
    promise(m, r, *s, bias, session.parallelism());
    return;
  }
}

}  // namespace

int most_searched(const MeasureOptions& o) {
  const int asked = (o.error ? 1 : 0) + (o.seconds ? 1 : 0);
  if (asked > 0) return asked * most_measured;
  const int of_own =
      std::bit_width(static_cast<unsigned>(most_samples_factor)) / 2 + 1;  // 4, 16, and its own
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
    const auto own = [&] { return whole_picture(m, tradeoff_of(m, *found(m, own_setting))); };
    const auto is_unsure = [&] {
      const MeasuredSetting& s = *found(m, own_setting);
      return is_too_uncertain(s.error.bias, s, m.settings[0].spp, predicted_error(own(), m.law, spp));
    };
    while (is_unsure())
      m.settings.push_back(session.measure_setting(m, own_setting, 4 * found(m, own_setting)->spp));
    const MeasuredSetting& known = *found(m, own_setting);
    if (const int checkable = session.checkable(known, spp); checkable > known.spp)
      m.settings.push_back(session.check(m, known, checkable));
    all.push_back({fmt::format("the error of the scene's own setting at its {} samples", spp),
                   {predicted_error(own(), m.law, spp), {}}});
    all.push_back({fmt::format("the time of the scene's own setting at its {} samples", spp),
                   {{}, predicted_cpu_s(own(), m.law, spp)}});
  }
  if (o.every_combination)
    for (const auto& [setting, guess] : combinations(m, false, o.most_bias))
      if (!found(m, setting)) m.settings.push_back(session.measure_setting(m, setting, m.settings[0].spp));
  for (Recommendation& r : all) {
    r.most_bias = o.most_bias;
    search(m, session, r);
  }
}

}  // namespace vitrail
