// SPDX-License-Identifier: Apache-2.0
// This file knows the biases of all settings, and which of them are small enough.
#pragma once

#include <map>

#include "measure/measure.h"

namespace vitrail {

// A verdict sets a change of the picture's mean light, with its interval, against the most that is allowed.
enum class LightVerdict { within, beyond, unsure };
LightVerdict judge(const Estimate& luminance, double most);

// Biases depend on the choices of the axes of Effect::bias, whatever the other axes' choices are.
class Biases {
 public:
  explicit Biases(const Measurement& m);

  // They return where such a setting's bias of relMSE, and where its light, is known best. They return
  // null where it was not measured.
  const MeasuredSetting* of(const Setting& setting) const;
  const MeasuredSetting* light_of(const Setting& setting) const;
  // Returns `t` with the bias that is known best.
  Tradeoff with(Tradeoff t, const Setting& setting) const;

 private:
  using Best = std::map<Setting, const MeasuredSetting*>;
  const MeasuredSetting* find(const Best& best, const Setting& setting) const;
  Setting part(Setting setting) const;
  const std::vector<Axis>& axes_;
  Best bias_, light_;
};

}  // namespace vitrail
