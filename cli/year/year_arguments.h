// SPDX-License-Identifier: Apache-2.0
// The command line of `vitrail year`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/year/year_figures.h"
#include "farm/plan/options.h"

namespace vitrail {

// Settings of the scene under a name: "dark=window.state=1,blind.color=0:0:0".
struct YearState {
  std::string name;
  std::vector<std::string> settings;
};

struct YearArguments {
  std::filesystem::path bundle, weather, sensors, output, rules;
  std::string up, north, memory, use = "8-18", progress = "auto";
  std::vector<std::string> states, settings;
  int division = 4, max_depth = -1;
  std::uint32_t sky_paths = 32768, sun_paths = 16;
  double ground = 0.2, sun_blur_deg = 3;
  FigureSettings figures;
  JobResources resources;
  std::uint64_t seed = 0;
  bool force = false, quiet = false, table = false;
  std::string command;
};

void declare(CLI::App& app, YearArguments& arguments);

// Throws UsageError.
void interpret(YearArguments& arguments);
// One without a name where none is asked for. Throws UsageError.
std::vector<YearState> states_of(const YearArguments& arguments);

}  // namespace vitrail
