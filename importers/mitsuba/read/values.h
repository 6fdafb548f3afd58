// SPDX-License-Identifier: Apache-2.0
// These functions read the text of attributes as values. All of them call `fail`, which throws Error.
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
// The numbers are separated by blanks or commas.
std::vector<double> parse_numbers(const std::string& text, const Fail& fail);
// It takes "r g b", one number for all three, or "#rrggbb" in sRGB.
RGB parse_rgb(const std::string& text, const Fail& fail);
// It takes one number, or "wavelength:value, …".
SpectrumValue parse_spectrum(const std::string& text, const Fail& fail);

}  // namespace vitrail::mitsuba
