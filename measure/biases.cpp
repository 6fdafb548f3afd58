// SPDX-License-Identifier: Apache-2.0
#include "measure/biases.h"

#include <cmath>

namespace vitrail {

LightVerdict judge(const Estimate& luminance, double most) {
  const double off = std::abs(luminance.value);
  if (off + luminance.half_width <= most) return LightVerdict::within;
  return off - luminance.half_width > most ? LightVerdict::beyond : LightVerdict::unsure;
}

Biases::Biases(const Measurement& m) : axes_(m.axes) {
  for (const MeasuredSetting& s : m.settings) {
    if (!s.failure.empty()) continue;
    const auto keep = [&](Best& best, Estimate ErrorStatistics::*of) {
      const auto [known, is_new] = best.try_emplace(part(s.setting), &s);
      if (!is_new && (s.error.*of).half_width < (known->second->error.*of).half_width) known->second = &s;
    };
    keep(bias_, &ErrorStatistics::bias);
    keep(light_, &ErrorStatistics::luminance);
  }
}

const MeasuredSetting* Biases::find(const Best& best, const Setting& setting) const {
  const auto known = best.find(part(setting));
  return known == best.end() ? nullptr : known->second;
}

const MeasuredSetting* Biases::of(const Setting& setting) const { return find(bias_, setting); }
const MeasuredSetting* Biases::light_of(const Setting& setting) const { return find(light_, setting); }

Tradeoff Biases::with(Tradeoff t, const Setting& setting) const {
  if (const MeasuredSetting* s = of(setting)) t.bias = s->tradeoff().bias;
  return t;
}

Setting Biases::part(Setting setting) const {
  for (std::size_t i = 0; i < setting.size(); ++i)
    if (axes_[i].effect != Effect::bias) setting[i] = 0;
  return setting;
}

}  // namespace vitrail
