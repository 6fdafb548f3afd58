// SPDX-License-Identifier: Apache-2.0
// These functions put a measurement in words, for the terminal and the page.
#pragma once

#include <string>
#include <vector>

#include "measure/measure.h"

namespace vitrail {

// Returns what a setting buys, against the scene's own: one sentence.
std::string what_it_buys(const Measurement& m, const MeasuredSetting& setting);
// Returns what was found of reference, samples and time: a sentence each.
std::vector<std::string> findings(const Measurement& m);
// Returns "render …" and its promise; or that nothing reaches the goal.
std::string advice(const Recommendation& r);
// Returns one line a setting, with a head.
std::string table(const Measurement& m);

// Returns which settings that made pictures no other beats in CPU time and in error at these samples.
std::vector<bool> front(const Measurement& m);

}  // namespace vitrail
