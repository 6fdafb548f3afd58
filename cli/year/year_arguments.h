// SPDX-License-Identifier: Apache-2.0
// This file is the command line of `vitrail year`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/year/year_figures.h"
#include "farm/plan/options.h"

namespace vitrail {

// A YearState has settings of the scene under a name, as in "dark=window.state=1,blind.color=0:0:0", or
// another bundle, as in "closed=room-with-blinds.vit".
struct YearState {
  std::string name;
  std::vector<std::string> settings;
  std::filesystem::path bundle;
};

struct YearArguments {
  std::filesystem::path bundle, weather, sensors, output, rules;
  std::string up, north, memory, heat, use = "8-18", progress = "auto";
  std::vector<std::string> states, settings, blinds;
  int division = 4, max_depth = -1;
  std::uint32_t sky_paths = 32768, sun_paths = 16;
  double ground = 0.2, sun_blur_deg = 3;
  std::string sun_day = "03-21";
  int sun_month = 3, sun_day_of_month = 21;  // of sun_day
  double sun_above_deg = 10;
  FigureSettings figures;
  JobResources resources;
  std::uint64_t seed = 0;
  bool force = false, quiet = false, table = false, file_lux = false, photochromic = false;
  std::string command;
};

void declare(CLI::App& app, YearArguments& arguments);

// --heat asks for the sun's heat through a glass, as in "window=glazing.json@3".
struct HeatThrough {
  std::string glass, file;
  std::size_t sensor = 0;  // from 0
};
// Throws UsageError.
HeatThrough heat_through(const YearArguments& arguments, std::size_t sensors);

// Throws UsageError.
void interpret(YearArguments& arguments);
// Returns one state without a name where none is asked for. Throws UsageError.
std::vector<YearState> states_of(const YearArguments& arguments);

}  // namespace vitrail
