// SPDX-License-Identifier: Apache-2.0
#include "cli/year/year_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "cli/common/number_checks.h"
#include "cli/common/sizes.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

void declare(CLI::App& app, YearArguments& a) {
  app.add_option("bundle", a.bundle, "a bundle (NAME.vit), which vitrail partition makes")->required();
  app.add_option("--weather", a.weather, "hours of a year: an EnergyPlus .epw or Radiance's .wea")
      ->required();
  app.add_option("--sensors", a.sensors, "places, as of vitrail render --sensors")->required();
  app.add_option("-o,--output", a.output, "folder for what is written; it is made if it is not there")
      ->required();
  app.add_option("--set", a.settings, "change the scene, as of vitrail render; may repeat")
      ->allow_extra_args(false);
  app.add_option("--state", a.states,
                 "NAME=SETTING,SETTING…: a state of the glass under a name, as in dark=window.state=1, or of "
                 "the room: closed=with-blinds.vit; each is traced; may repeat")
      ->allow_extra_args(false);
  app.add_option("--rules", a.rules,
                 "JSON that tells the state of each hour; default: the first state, always");
  app.add_option("--blinds", a.blinds,
                 "the state in which blinds are closed: that of each hour in which more than 2 % of the "
                 "sensors that face up would have more than 1000 lx of the sun alone (LM-83). It may repeat: "
                 "one state for each group of windows, in which that group alone is closed")
      ->allow_extra_args(false);
  app.add_option("--up", a.up,
                 "axis of the scene that points up, as z; default: as in the bundle's sky, else z");
  app.add_option("--north", a.north,
                 "axis of the scene that points north, as -y; default: as in the bundle's sky, else y");
  app.add_option("--patches", a.division,
                 "the sky has 145 patches (1), 577 (2) or 2305 (4): Reinhart's division of Tregenza's")
      ->check(CLI::IsMember({1, 2, 4}))
      ->capture_default_str();
  app.add_flag("--file-lux", a.file_lux,
               "take the illuminances of the .epw, where it has them, not its W/m² by Perez's efficacies");
  app.add_option("--ground", a.ground, "reflectance of the ground below the horizon, where no surface is")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--paths", a.sky_paths, "paths of a sensor that look for the sky; at least two a patch")
      ->transform(plain_count)
      ->check(CLI::Range(std::uint32_t{2}, std::uint32_t{1} << 30))
      ->capture_default_str();
  app.add_option("--sun-paths", a.sun_paths,
                 "paths of a sensor that look for the sun of each hour; an even number")
      ->transform(plain_count)
      ->check(CLI::Range(std::uint32_t{2}, std::uint32_t{1} << 20))
      ->capture_default_str();
  app.add_option(
         "--sun-blur", a.sun_blur_deg,
         "what surfaces reflect of a sun is the mean over suns that are nearer than this, in degrees; 0: of "
         "each sun alone, with more --sun-paths")
      ->check(CLI::Range(0.0, 30.0))
      ->capture_default_str();
  app.add_option("--max-depth", a.max_depth, "most scattering events of a path; -1: no limit")
      ->check(CLI::Range(-1, 1'000'000))
      ->capture_default_str();
  app.add_option("--seed", a.seed, "number that starts all randomness")
      ->check(not_below_0)
      ->capture_default_str();
  app.add_option("--use", a.use, "hours of use by the file's clock")->capture_default_str();
  app.add_option("--target", a.figures.target_lx, "illuminance that DA, cDA and sDA ask for, lx")
      ->check(more_than_0)
      ->capture_default_str();
  app.add_option("--sun-day", a.sun_day,
                 "day, as MM-DD, whose hours of sun EN 17037 counts at sensors that do not face up")
      ->capture_default_str();
  app.add_option("--sun-above", a.sun_above_deg,
                 "height of the sun, in degrees, from which on it counts there; each country has its own")
      ->check(CLI::Range(0.0, 89.0))
      ->capture_default_str();
  app.add_option("--heat", a.heat,
                 "NAME=PANES@SENSOR: the sun's heat that glass lets in, W/m²: its name, its file, and the "
                 "number of a sensor outside that faces as it does");
  app.add_flag(
      "--photochromic", a.photochromic,
      "the glass of --heat follows its own kinetics, by the ultraviolet light on it: each hour has the "
      "nearest of the states");
  app.add_option("--memory", a.memory, "most memory a rank may use, e.g. 512M or 2G; default: as of render");
  app.add_option("-t,--threads", a.resources.threads, "threads a rank; default: one a processor allowed")
      ->check(CLI::Range(1, 4096));
  app.add_option("--checkpoint-every", a.resources.checkpoint_every_s,
                 "seconds between checkpoints; 0: only on signals")
      ->transform(plain_seconds)
      ->check(not_below_0)
      ->capture_default_str();
  app.add_option(
         "--patience", a.resources.patience_s,
         "seconds after which a rank or a file without an answer ends the job; default: 600, 0: never")
      ->transform(plain_seconds)
      ->check(not_below_0);
  app.add_flag("--force", a.force, "begin anew, and replace what other settings left in the folder");
  app.add_flag("--table", a.table, "write the coefficients as text (.csv), too");
  app.add_option("--progress", a.progress, "auto: a bar on a terminal, else lines")
      ->check(CLI::IsMember({"auto", "bar", "lines", "none"}))
      ->capture_default_str();
  app.add_flag("--quiet", a.quiet, "print the figures and problems only");
}

namespace {

// "8-18".
void interpret_use(YearArguments& a) {
  const char *at = a.use.data(), *const end = at + a.use.size();
  const auto first = std::from_chars(at, end, a.figures.first_hour);
  const bool has_dash = first.ec == std::errc() && first.ptr != end && *first.ptr == '-';
  const auto last = has_dash ? std::from_chars(first.ptr + 1, end, a.figures.last_hour) : first;
  if (!has_dash || last.ec != std::errc() || last.ptr != end || a.figures.first_hour < 0 ||
      a.figures.last_hour > 24 || a.figures.first_hour >= a.figures.last_hour)
    throw UsageError("--use takes two hours of the day, such as 8-18: " + a.use);
}

// "03-21".
void interpret_sun_day(YearArguments& a) {
  try {
    const LocalTime day = local_time("2023-" + a.sun_day + "T12:00Z");
    a.sun_month = day.month, a.sun_day_of_month = day.day;
  } catch (const Error&) {
    throw UsageError("--sun-day takes a month and a day, such as 02-01: " + a.sun_day);
  }
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == '+';
  }) && name.front() != '.';
}

}  // namespace

void interpret(YearArguments& a) {
  interpret_use(a);
  interpret_sun_day(a);
  if (!a.memory.empty()) a.resources.memory_bytes = parse_bytes(a.memory);
  a.sun_paths += a.sun_paths % 2;
  if (!a.rules.empty() && a.states.size() < 2)
    throw UsageError("--rules choose between states: give --state at least twice");
  const std::vector<YearState> states = states_of(a);
  if (a.photochromic && (a.heat.empty() || !a.rules.empty() || states.size() < 2))
    throw UsageError("--photochromic needs --heat and at least two --state, and no --rules");
  for (const std::string& closed : a.blinds)
    if (states.size() < 2 || std::ranges::find(states, closed, &YearState::name) == states.end() ||
        std::ranges::count(a.blinds, closed) > 1)
      throw UsageError("--blinds takes each of at least two states, which --state names, once: " + closed);
  if (a.blinds.size() > 1 && (!a.rules.empty() || a.photochromic))
    throw UsageError(
        "several --blinds are changes of the first state: they take no --rules or --photochromic");
}

HeatThrough heat_through(const YearArguments& a, std::size_t sensors) {
  const std::size_t equals = a.heat.find('='), at = a.heat.rfind('@');
  HeatThrough heat;
  const char* const end = a.heat.data() + a.heat.size();
  const bool has_both = equals != a.heat.npos && at != a.heat.npos && equals > 0 && equals + 1 < at;
  const auto read = has_both ? std::from_chars(a.heat.data() + at + 1, end, heat.sensor)
                             : std::from_chars_result{end, std::errc::invalid_argument};
  if (read.ec != std::errc() || read.ptr != end || heat.sensor < 1 || heat.sensor > sensors)
    throw UsageError(
        fmt::format("--heat takes a glass, its file and a sensor, 1 to {}, as in window=panes.json@3: {}",
                    sensors, a.heat));
  heat.glass = a.heat.substr(0, equals), heat.file = a.heat.substr(equals + 1, at - equals - 1);
  --heat.sensor;
  return heat;
}

std::vector<YearState> states_of(const YearArguments& a) {
  std::vector<YearState> states;
  for (const std::string& text : a.states) {
    const std::size_t equals = text.find('=');
    YearState state{text.substr(0, equals), a.settings, a.bundle};
    if (equals == text.npos || !is_plain_name(state.name))
      throw UsageError(
          "--state takes a name of letters, digits, -, + and _, and settings behind it, as in "
          "dark=window.state=1: " +
          text);
    if (std::ranges::find(states, state.name, &YearState::name) != states.end())
      throw UsageError(fmt::format("--state {}: there are two of this name", state.name));
    std::istringstream list(text.substr(equals + 1));
    for (std::string setting; std::getline(list, setting, ',');) {
      if (setting.ends_with(".vit"))
        state.bundle = setting;
      else if (!setting.empty())
        state.settings.push_back(setting);
    }
    states.push_back(std::move(state));
  }
  if (states.empty()) states.push_back({"as-it-is", a.settings, a.bundle});
  return states;
}

}  // namespace vitrail
