// SPDX-License-Identifier: Apache-2.0
// What stands in attributes, as values. All throw Error at `where`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "importers/mitsuba/read/object.h"

namespace vitrail::mitsuba {

// Says what is wrong at the place that is being read.
using Fail = std::function<void(const std::string& message)>;

double parse_number(const std::string& text, const Fail& fail);
long long parse_integer(const std::string& text, const Fail& fail);
bool parse_boolean(const std::string& text, const Fail& fail);
// Separated by blanks or commas.
std::vector<double> parse_numbers(const std::string& text, const Fail& fail);
// "r g b", one number for all three, or "#rrggbb" in sRGB.
RGB parse_rgb(const std::string& text, const Fail& fail);
// One number, or "wavelength:value, …".
SpectrumValue parse_spectrum(const std::string& text, const Fail& fail);

}  // namespace vitrail::mitsuba
