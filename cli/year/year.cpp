// SPDX-License-Identifier: Apache-2.0
// vitrail year: daylight over a year. Coefficients are traced once; the hours are a product with the weather.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <span>

#include "bundle/manifest.h"
#include "cli/common/main_guard.h"
#include "cli/common/rank_guard.h"
#include "cli/common/switching_glazing.h"
#include "cli/year/state_rules.h"
#include "cli/year/year_arguments.h"
#include "cli/year/year_inputs.h"
#include "cli/year/year_jobs.h"
#include "cli/year/year_output.h"
#include "farm/files/output_lock.h"
#include "farm/files/signals.h"
#include "farm/run/patience.h"
#include "farm/run/watchdog.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "film/film_progress.h"
#include "glazing/system_file.h"
#include "scene/models/sensor_file.h"
#include "scene/system/machine_limits.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

namespace vitrail {
namespace {

namespace fs = std::filesystem;

void check_files(const YearArguments& a) {
  std::error_code unknown;
  if (!fs::exists(a.bundle, unknown))
    throw Error("there is no such bundle; vitrail partition makes one of a scene", {a.bundle.string()});
  if (!fs::exists(a.bundle / "manifest.json", unknown))
    throw Error("this is no bundle; vitrail partition makes one of a scene", {a.bundle.string()});
  if (fs::exists(a.output, unknown) && !fs::is_directory(a.output, unknown))
    throw UsageError("--output is a folder, and this is a file: " + a.output.string());
  if (!fs::is_directory(a.output, unknown) && !fs::create_directory(a.output, unknown))
    throw MachineError(fmt::format("cannot make the folder {}: {}", a.output.string(), unknown.message()));
}

// What is known before anything is traced, alike on all ranks.
struct Known {
  SkyFrame frame;
  std::vector<Sensor> sensors;
  WeatherYear weather;
  SkyYear year;
  std::vector<Vector3d> minutes;  // suns of the day whose sunlight is counted
  NearSuns near;
  StateRules rules;
};

std::vector<std::string> names_of(const std::vector<YearState>& states) {
  std::vector<std::string> names;
  for (const YearState& state : states) names.push_back(state.name);
  return names;
}

// Those that face up.
std::vector<bool> sensors_of_area(const Known& known) {
  constexpr double level = 0.999;
  std::vector<bool> in_area;
  for (const Sensor& s : known.sensors) in_area.push_back(dot(s.normal, known.frame.frame.z) > level);
  return in_area;
}

Known read_all(const YearArguments& a) {
  const Manifest manifest = read_manifest(a.bundle);
  Known known{.frame = sky_frame(a, manifest),
              .sensors = read_sensors(a.sensors),
              .weather = read_weather_year(a.weather),
              .year = {},
              .minutes = {},
              .near = {},
              .rules = {}};
  known.year = sky_year(known.weather, SkyPatches(a.division), a.ground, a.file_lux);
  known.near = near_suns(known.year.suns, a.sun_blur_deg);
  if (!a.heat.empty()) heat_through(a, known.sensors.size());
  if (!a.rules.empty()) known.rules = read_state_rules(a.rules, names_of(states_of(a)), known.sensors.size());
  if (std::ranges::count(sensors_of_area(known), false) > 0)
    known.minutes = suns_of_day(known.weather, a.sun_month, a.sun_day_of_month, a.sun_above_deg);
  return known;
}

void say_what_is_known(const YearArguments& a, const Known& known) {
  if (known.weather.missing > 0)
    say("vitrail: {}: {} hours have no measurement (9999) and count as dark\n", a.weather.string(),
        known.weather.missing);
  if (known.year.without_lux > 0)
    say("vitrail: {}: {} hours have no illuminances: theirs are of the W/m2, by Perez\n", a.weather.string(),
        known.year.without_lux);
  if (!is_whole_year(known.year))
    say("vitrail: {}: {} hours are no year: DA, UDI, sDA, ASE and EN 17037 are of these hours alone\n",
        a.weather.string(), known.year.hours.size());
  if (std::ranges::none_of(sensors_of_area(known), [](bool in) { return in; }))
    say("vitrail: no sensor faces up, and there is no area for sDA, ASE and EN 17037\n");
  if (a.quiet) return;
  say("vitrail: {}: {} hours, {} with sun; {} sensors; {}\n", a.weather.string(), known.year.hours.size(),
      known.year.suns.size(), known.sensors.size(), known.frame.words);
}

StateCoefficients read_coefficients(const YearArguments& a, const std::string& state, const NearSuns& near) {
  const auto read = [&](CoefficientKind kind) {
    return coefficients_of(read_film(film_of(a, state, kind), nullptr), kind == CoefficientKind::sky);
  };
  StateCoefficients c{state, read(CoefficientKind::sky), {}, {}, {}};
  if (!near.of.empty()) set_suns(c, read(CoefficientKind::beams), read(CoefficientKind::reflected), near);
  return c;
}

void write_coefficients(const YearArguments& a, const StateCoefficients& c) {
  const auto write = [&](const char* name, const Coefficients& of, const char* unit) {
    if (of.lights == 0) return;
    const auto file = [&](const char* end) { return a.output / fmt::format("{}.{}{}", c.name, name, end); };
    write_npy(file(".npy"), of, of.mean);
    write_npy(file("-error.npy"), of, of.error);
    if (a.table) write_coefficients_table(file(".csv"), of, unit);
  };
  write("sky", c.sky, "lx_per_cd_m2");
  write("sun", c.suns, "lx_per_lx");
  write("beam", c.beams, "lx_per_lx");
}

std::vector<std::size_t> states_of_hours(const Known& known, const std::vector<StateCoefficients>& states) {
  std::map<std::size_t, std::vector<float>> lux;
  for (const std::size_t sensor : sensors_of(known.rules))
    lux[sensor] = lux_of_sensor(known.year, states[known.rules.otherwise], sensor);
  return states_of(known.rules, known.year, [&](std::size_t sensor, std::size_t hour) {
    return static_cast<double>(lux[sensor][hour]);
  });
}

// The glass of --heat in each of the states.
std::vector<GlazingSystem> glass_of_states(const YearArguments& a, const HeatThrough& through) {
  const GlazingSystem as_it_is = read_system({through.file}).system;
  std::vector<GlazingSystem> systems;
  for (const YearState& state : states_of(a)) {
    systems.push_back(as_it_is);
    for (const std::string& text : state.settings)
      if (text.starts_with(through.glass + ".") && !is_scene_edit(text)) {
        const GlazingSetting setting = parse_settings({text}).front();
        set(systems.back(), setting.quantity, setting.value);
      }
  }
  return systems;
}

// What the glass lets in. Glass that follows its own kinetics tells the states of the hours.
SolarHeat heat_of(const YearArguments& a, const Known& known, const std::vector<StateCoefficients>& states,
                  std::vector<std::size_t>& of_hours) {
  const HeatThrough through = heat_through(a, known.sensors.size());
  const std::vector<GlazingSystem> systems = glass_of_states(a, through);
  std::vector<SolarGain> gains;
  for (const GlazingSystem& system : systems) gains.push_back(solar_gain(system));
  const auto heat = [&] {
    return solar_heat(known.year, SkyPatches(a.division), states, gains, of_hours, through.sensor,
                      known.frame.frame.to_light(known.sensors[through.sensor].normal));
  };
  if (!a.photochromic) return heat();
  const auto photochromic = std::ranges::find_if(
      systems.front().layers, [](const GlazingLayer& layer) { return layer.light.has_value(); });
  if (photochromic == systems.front().layers.end()) throw Error("this glass has no kinetics", {through.file});
  std::vector<double> values;
  for (const GlazingSystem& system : systems) values.push_back(value_of(system, Quantity::state).value_or(0));
  of_hours = photochromic_states(*photochromic->light, values, heat().on_the_pane);
  return heat();
}

// On one rank: the films' product with the weather.
void conclude(const YearArguments& a, const Known& known, bool is_whole) {
  std::vector<StateCoefficients> states;
  for (const YearState& state : states_of(a)) {
    states.push_back(read_coefficients(a, state.name, known.near));
    write_coefficients(a, states.back());
  }
  YearReport report;
  report.bundle = a.bundle.string(), report.weather = a.weather.string(), report.command = a.command;
  report.place = known.weather.place, report.missing_hours = known.weather.missing;
  report.patch_division = a.division, report.settings = a.figures;
  report.sensors = known.sensors, report.in_area = sensors_of_area(known);
  report.state_names = names_of(states_of(a));
  std::vector<std::size_t> open = states_of_hours(known, states);
  if (!a.heat.empty()) report.heat = heat_of(a, known, states, open);
  report.states = {open, open, known.rules.otherwise};
  if (!a.blinds.empty()) {
    std::vector<std::size_t> closed;
    for (const std::string& name : a.blinds)
      closed.push_back(
          static_cast<std::size_t>(std::ranges::find(report.state_names, name) - report.state_names.begin()));
    const std::size_t traced = states.size();
    report.states = close_blinds(known.year, states, std::move(report.states), closed, report.in_area);
    for (std::size_t i = traced; i < states.size(); ++i) report.state_names.push_back(states[i].name);
  }
  report.blinds_move = !a.blinds.empty();
  report.counted = counted_hours(known.year, a.figures);
  for (std::size_t s = 0; s < known.sensors.size(); ++s)
    report.sensor_years.push_back(
        sensor_year(known.year, known.near, states, report.states, s, report.counted, a.figures));
  report.year = known.year;
  report.area =
      area_figures(report.sensor_years, report.in_area, median_diffuse_lx(report.year, report.counted));
  report.sun_day = a.sun_day, report.sun_above_deg = a.sun_above_deg;
  if (!known.minutes.empty())
    report.sunlight_h = sunlight_hours(coefficients_of(
        read_film(film_of(a, states[known.rules.otherwise].name, CoefficientKind::sunlight), nullptr),
        false));
  write_hours(a.output, report);
  write_figures(a.output, report);
  write_area(a.output, report);
  write_sunlight(a.output, report);
  write_heat(a.output, report);
  write_page(a.output, report);
  if (is_whole)
    show("{}", words_of_area(report));
  else
    say("vitrail: so far, by an eighth of the paths ({}):\n{}", (a.output / "index.html").string(),
        words_of_area(report));
}

int year_job(Transport& transport, YearArguments& a) {
  const bool first = transport.rank() == 0;
  agree(transport, [&] { interpret(a); });
  std::unique_ptr<OutputLock> lock;
  agree(transport, [&] {
    if (!first) return;
    check_files(a);
    lock = wait_for_lock(a.output / "year", std::chrono::seconds(5));
  });
  Known known;
  now_doing("reading the weather");
  agree(transport,
        [&] { within_job(memory_limit(0).of_a_job(), "reading the weather", [&] { known = read_all(a); }); });
  agree(transport, [&] {
    if (first) require_same_inputs(a, known.year.suns, known.sensors);
  });
  if (first) say_what_is_known(a, known);
  // A page is there soon, and again with all paths.
  std::uint64_t begins[] = {0};
  agree_on_root(transport, [&] { begins[0] = !a.quiet && (a.force || !has_films(a)); });
  transport.broadcast_from_root(begins);
  std::vector<double> shares{1};
  if (begins[0] != 0) shares.insert(shares.begin(), 0.125);
  for (const double share : shares) {
    trace_coefficients(transport, a, known.frame, {known.year.suns, known.minutes, known.rules.otherwise},
                       share);
    a.force = false;
    now_doing("multiplying by the weather");
    agree_on_root(transport, [&] { conclude(a, known, share == 1); });
  }
  return exit_done;
}

std::string typed_command(std::span<char*> words) {
  std::string line = "vitrail year";
  for (const std::string word : words.subspan(1)) line += " " + word;
  return line;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  catch_checkpoint_signal();
  CLI::App app("Daylight over a year of weather: coefficients are traced once, and hours are products.",
               "vitrail year");
  YearArguments arguments;
  arguments.command = typed_command(std::span(argv, static_cast<std::size_t>(argc)));
  declare(app, arguments);
  const int status = run_guarded(app, argc, argv, [&] {
    Watchdog watchdog(arguments.resources.patience_s);
    now_doing("starting MPI");
    if (launched_by_mpi()) watchdog.expect_reports();
    const auto transport = make_transport(&argc, &argv);
    Patience patience(*transport, watchdog, arguments.resources.patience_s);
    const int end =
        run_guarded([&] { return guarded(*transport, [&] { return year_job(*transport, arguments); }); });
    patience.leave(/*failed=*/end == exit_usage || end == exit_bad_input || end == exit_machine);
    return end;
  });
  // mpirun takes a rank that dies of a signal for a failure of the job.
  return launched_by_mpi() ? status : end_with(status);
}
