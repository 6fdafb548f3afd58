// SPDX-License-Identifier: Apache-2.0
// These functions write the files of a year of daylight.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/year/solar_heat.h"
#include "scene/records/camera.h"

namespace vitrail {

// A YearReport is all that is written.
struct YearReport {
  std::string bundle, weather, command;
  Site place;
  std::size_t missing_hours = 0;
  int patch_division = 1;
  FigureSettings settings;
  SkyYear year;
  std::vector<Sensor> sensors;
  std::vector<bool> in_area;  // which of them the figures over the area count
  std::vector<std::string> state_names;
  StatesOfYear states;
  bool blinds_move = false;
  std::vector<SensorYear> sensor_years;
  CountedHours counted;
  AreaFigures area;
  // They are EN 17037's hours of sun on that day, of each sensor; empty where none looks sideways.
  std::string sun_day;
  double sun_above_deg = 0;
  std::vector<double> sunlight_h;
  std::optional<SolarHeat> heat;
};

// Writes hours.csv, an hour a row, lx of the sensors; hours-error.csv, their standard errors; and
// hours-melanopic.csv, lx of melanopic EDI.
void write_hours(const std::filesystem::path& folder, const YearReport& report);
// Writes figures.csv: a sensor a row.
void write_figures(const std::filesystem::path& folder, const YearReport& report);
// Writes sunlight.csv: the hours of sun of each sensor that does not face up.
void write_sunlight(const std::filesystem::path& folder, const YearReport& report);
// Writes heat.csv: an hour a row, the sun's heat on the glass and through it.
void write_heat(const std::filesystem::path& folder, const YearReport& report);
// Writes area.csv: a figure a row.
void write_area(const std::filesystem::path& folder, const YearReport& report);
// Writes SENSOR by LIGHT as text.
void write_coefficients_table(const std::filesystem::path& file, const Coefficients& coefficients,
                              const char* unit);
// Writes index.html, which needs no other file.
void write_page(const std::filesystem::path& folder, const YearReport& report);

// Returns the figures over the area as they are printed, a line each, and the longest sunlight of a sensor.
std::string words_of_area(const YearReport& report);
// Returns which of the sensors that do not face up has most hours of sun; none: there is none.
std::optional<std::size_t> sunniest(const YearReport& report);

// An AreaRow is a figure over the area, for tables and pages.
struct AreaRow {
  std::string name, words;
  YearEstimate estimate;
  bool is_printed = true;
};
std::vector<AreaRow> area_rows(const YearReport& report);

}  // namespace vitrail
