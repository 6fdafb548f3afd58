// SPDX-License-Identifier: Apache-2.0
// What a year of daylight is written as.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/year/year_figures.h"
#include "scene/records/camera.h"

namespace vitrail {

// All that is written.
struct YearReport {
  std::string bundle, weather, command;
  Place place;
  std::size_t missing_hours = 0;
  int patch_division = 1;
  FigureSettings settings;
  SkyYear year;
  std::vector<Sensor> sensors;
  std::vector<bool> in_area;  // which of them the figures over the area count
  std::vector<std::string> state_names;
  std::vector<std::size_t> states;  // of each hour
  std::vector<SensorYear> sensor_years;
  CountedHours counted;
  AreaFigures area;
};

// hours.csv: an hour a row, lx of the sensors; hours-error.csv: their standard errors.
void write_hours(const std::filesystem::path& folder, const YearReport& report);
// figures.csv: a sensor a row.
void write_figures(const std::filesystem::path& folder, const YearReport& report);
// area.csv: a figure a row.
void write_area(const std::filesystem::path& folder, const YearReport& report);
// SENSOR by LIGHT as text.
void write_coefficients_table(const std::filesystem::path& file, const Coefficients& coefficients,
                              const char* unit);
// index.html, which needs no other file.
void write_page(const std::filesystem::path& folder, const YearReport& report);

// The figures over the area as they are printed, a line each.
std::string words_of_area(const YearReport& report);

// A figure over the area, for tables and pages.
struct AreaRow {
  std::string name, words;
  Estimate estimate;
};
std::vector<AreaRow> area_rows(const YearReport& report);

}  // namespace vitrail
