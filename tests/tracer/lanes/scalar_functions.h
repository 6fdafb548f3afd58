// SPDX-License-Identifier: Apache-2.0
// What the functions in lanes are held to, and with which arguments.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/tracer/lanes/arguments.h"
#include "tests/tracer/lanes/lane_functions.h"

namespace vitrail::lane_tests {

struct ScalarFunction {
  std::string name;
  std::vector<Argument> arguments;
  std::function<void(const Context&, const double* in, double* out)> run;
};

inline void PrintTo(const ScalarFunction& f, std::ostream* out) { *out << f.name; }

std::vector<ScalarFunction> sampling_functions();
std::vector<ScalarFunction> geometry_functions();
std::vector<ScalarFunction> scattering_functions();
std::vector<ScalarFunction> stage_functions();
std::vector<ScalarFunction> sphere_functions();
std::vector<ScalarFunction> glossy_functions();
std::vector<ScalarFunction> environment_functions();

}  // namespace vitrail::lane_tests
