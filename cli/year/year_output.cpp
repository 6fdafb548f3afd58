// SPDX-License-Identifier: Apache-2.0
#include "cli/year/year_output.h"

#include <fmt/format.h>

#include <iterator>

#include "compare/web_page.h"

namespace vitrail {

namespace {

// Rows of text that grow fast.
using Buffer = fmt::memory_buffer;

template <class... Values>
void add(Buffer& buffer, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(buffer), format, std::forward<Values>(values)...);
}

void write(const std::filesystem::path& file, const Buffer& buffer) {
  write_whole(file, {buffer.data(), buffer.size()});
}

void write_hours_of(const std::filesystem::path& file, const YearReport& r, const char* unit,
                    std::vector<float> SensorYear::*values) {
  Buffer text;
  add(text,
      "month,day,hour,sun_elevation_deg,sun_azimuth_deg,direct_normal_lx,diffuse_horizontal_lx,global_"
      "horizontal_lx,state");
  for (std::size_t s = 0; s < r.sensor_years.size(); ++s) add(text, ",sensor_{}_{}", s + 1, unit);
  add(text, "\n");
  for (std::size_t h = 0; h < r.year.hours.size(); ++h) {
    const YearHour& hour = r.year.hours[h];
    add(text, "{},{},{},{:.3f},{:.3f},{:.1f},{:.1f},{:.1f},{}", hour.middle.month, hour.middle.day,
        hour.clock_hour(), hour.elevation_deg, hour.azimuth_deg, hour.direct_normal_lx, hour.diffuse_lx,
        hour.global_lx, r.state_names[r.states.of_hours[h]]);
    for (const SensorYear& s : r.sensor_years) add(text, ",{:.1f}", (s.*values)[h]);
    add(text, "\n");
  }
  write(file, text);
}

std::string percent(const YearEstimate& e) {
  return fmt::format("{:.1f} ± {:.1f} %", 100 * e.value, 100 * e.error);
}

}  // namespace

void write_hours(const std::filesystem::path& folder, const YearReport& report) {
  write_hours_of(folder / "hours.csv", report, "lx", &SensorYear::lux);
  write_hours_of(folder / "hours-error.csv", report, "error_lx", &SensorYear::error);
  write_hours_of(folder / "hours-melanopic.csv", report, "melanopic_edi_lx", &SensorYear::melanopic);
}

void write_figures(const std::filesystem::path& folder, const YearReport& r) {
  const std::vector<FigureKind> kinds = figure_kinds();
  Buffer text;
  add(text, "sensor,x,y,z,nx,ny,nz,in_area");
  for (const FigureKind& kind : kinds) add(text, ",{0},{0}_error", kind.name);
  add(text, "\n");
  for (std::size_t s = 0; s < r.sensors.size(); ++s) {
    const auto& [p, n] = r.sensors[s];
    add(text, "{},{},{},{},{:.6g},{:.6g},{:.6g},{}", s + 1, p.x, p.y, p.z, n.x, n.y, n.z,
        r.in_area[s] ? 1 : 0);
    for (std::size_t f = 0; f < figure_count; ++f) {
      const YearEstimate e = r.sensor_years[s].estimate(static_cast<Figure>(f));
      add(text, ",{:.5g},{:.2g}", e.value, e.error);
    }
    add(text, "\n");
  }
  write(folder / "figures.csv", text);
}

std::vector<AreaRow> area_rows(const YearReport& r) {
  const AreaFigures& a = r.area;
  const double target = r.settings.target_lx;
  const char* const blinds = r.blinds_move ? "" : " without blinds";
  std::vector<AreaRow> rows{
      {fmt::format("sDA {:g},50%{}", target, blinds),
       fmt::format("share of the area with {:g} lx or more in half of the hours of use", target), a.autonomy},
      {fmt::format("ASE 1000,250h{}", blinds),
       "share of the area with more than 1000 lx of the sun alone in more than 250 hours of use", a.sunlight},
      {fmt::format("mean DA {:g}", target), "daylight autonomy, the mean over the area", a.mean_autonomy}};
  for (const AreaFigures::Level& level : a.provision) {
    rows.push_back({fmt::format("EN 17037 {}: {:g} lx", level.name, level.target_lx),
                    "share of the area that has them in half of the daylight hours; 50 % are asked for",
                    level.target});
    rows.push_back({fmt::format("EN 17037 {}: {:g} lx", level.name, level.minimum_lx),
                    "the same; 95 % are asked for", level.minimum});
  }
  for (const AreaFigures::Level& level : a.provision) {
    const auto row = [&](double lx, const char* asked, const YearEstimate& estimate) {
      const double percent = a.median_diffuse_lx > 0 ? 100 * lx / a.median_diffuse_lx : 0;
      rows.push_back(
          {fmt::format("EN 17037 {}: factor {:.2f} %", level.name, percent),
           fmt::format("share of the area with such a daylight factor, {:g} lx over the median {:.0f} lx "
                       "of the sky outdoors; {} are asked for",
                       lx, a.median_diffuse_lx, asked),
           estimate, false});
    };
    row(level.target_lx, "50 %", level.target_by_factor);
    row(level.minimum_lx, "95 %", level.minimum_by_factor);
  }
  return rows;
}

void write_area(const std::filesystem::path& folder, const YearReport& report) {
  Buffer text;
  add(text, "figure,share,error\n");
  for (const AreaRow& row : area_rows(report))
    add(text, "\"{}\",{:.5g},{:.2g}\n", row.name, row.estimate.value, row.estimate.error);
  write(folder / "area.csv", text);
}

std::string words_of_area(const YearReport& report) {
  std::string text;
  for (const AreaRow& row : area_rows(report))
    if (row.is_printed) text += fmt::format("{:34} {:>16}\n", row.name, percent(row.estimate));
  std::string_view reached = "none", by_factor = "none";
  for (const AreaFigures::Level& level : report.area.provision) {
    if (level.holds()) reached = level.name;
    if (level.holds_by_factor()) by_factor = level.name;
  }
  text += fmt::format("{:34} {:>16}\n{:34} {:>16}\n", "EN 17037 daylight provision", reached,
                      "the same by daylight factors", by_factor);
  if (const auto s = sunniest(report)) {
    const double hours = report.sunlight_h[*s];
    const std::string_view level = sunlight_level(hours);
    text += fmt::format("EN 17037 sunlight on {}: {:.1f} h at sensor {}, {}\n", report.sun_day, hours, *s + 1,
                        level.empty() ? "none" : level);
  }
  if (report.heat)
    text += fmt::format("{:34} {:.1f} ± {:.1f} kWh/m² of glass\n", "solar heat let in",
                        report.heat->year_kwh.value, report.heat->year_kwh.error);
  return text;
}

void write_heat(const std::filesystem::path& folder, const YearReport& r) {
  if (!r.heat) return;
  Buffer text;
  add(text, "month,day,hour,state,on_the_pane_w_m2,let_in_w_m2\n");
  for (std::size_t h = 0; h < r.year.hours.size(); ++h) {
    const YearHour& hour = r.year.hours[h];
    add(text, "{},{},{},{},{:.1f},{:.1f}\n", hour.middle.month, hour.middle.day, hour.clock_hour(),
        r.state_names[r.states.of_hours[h]], r.heat->on_the_pane[h], r.heat->let_in[h]);
  }
  write(folder / "heat.csv", text);
}

std::optional<std::size_t> sunniest(const YearReport& r) {
  std::optional<std::size_t> most;
  for (std::size_t s = 0; s < r.sunlight_h.size(); ++s)
    if (!r.in_area[s] && (!most || r.sunlight_h[s] > r.sunlight_h[*most])) most = s;
  return most;
}

void write_sunlight(const std::filesystem::path& folder, const YearReport& r) {
  if (!sunniest(r)) return;
  Buffer text;
  add(text, "sensor,x,y,z,nx,ny,nz,sunlight_h,level\n");
  for (std::size_t s = 0; s < r.sunlight_h.size(); ++s) {
    const auto& [p, n] = r.sensors[s];
    if (!r.in_area[s])
      add(text, "{},{},{},{},{:.6g},{:.6g},{:.6g},{:.3f},{}\n", s + 1, p.x, p.y, p.z, n.x, n.y, n.z,
          r.sunlight_h[s], sunlight_level(r.sunlight_h[s]));
  }
  write(folder / "sunlight.csv", text);
}

void write_coefficients_table(const std::filesystem::path& file, const Coefficients& c, const char* unit) {
  Buffer text;
  add(text, "sensor,light,{0},error_{0}\n", unit);
  for (std::size_t s = 0; s < c.sensors; ++s)
    for (std::size_t i = 0; i < c.lights; ++i)
      add(text, "{},{},{:.6g},{:.2g}\n", s + 1, i, c.of(s)[i], c.errors_of(s)[i]);
  write(file, text);
}

}  // namespace vitrail
