// SPDX-License-Identifier: Apache-2.0
// What is known of the biases of all settings, and which of them are small enough.
#pragma once

#include <map>

#include "measure/measure.h"

namespace vitrail {

// What a change of the picture's mean light is beside the most that is allowed, after its interval.
enum class LightVerdict { within, beyond, unsure };
LightVerdict judge(const Estimate& luminance, double most);

// They depend on the axes that have one, whatever the others are.
class Biases {
 public:
  explicit Biases(const Measurement& m);

  // Where the bias of relMSE, and where the light, of such a setting is known best. Null where neither was
  // measured.
  const MeasuredSetting* of(const Setting& setting) const;
  const MeasuredSetting* light_of(const Setting& setting) const;
  // With the bias that is known best.
  Tradeoff with(Tradeoff t, const Setting& setting) const;

 private:
  using Best = std::map<Setting, const MeasuredSetting*>;
  const MeasuredSetting* find(const Best& best, const Setting& setting) const;
  Setting part(Setting setting) const;
  const std::vector<Axis>& axes_;
  Best bias_, light_;
};

}  // namespace vitrail
