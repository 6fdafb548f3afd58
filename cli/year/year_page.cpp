// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "cli/common/svg.h"
#include "cli/year/year_output.h"
#include "compare/web_page.h"

namespace vitrail {

namespace {

constexpr const char* style = "figure{display:inline-block;margin:0 1.5em 1em 0}";

// From dark blue over green to yellow, for `share` in [0, 1].
std::string color_of(double share) {
  constexpr std::array<std::array<double, 3>, 5> stops{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double place = std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0) * (stops.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(low);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i)
    rgb[i] = static_cast<int>(std::lround(stops[low][i] + (stops[low + 1][i] - stops[low][i]) * part));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string square(double x, double y, double width, double height, const std::string& color,
                   const std::string& title) {
  return fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
      "fill=\"{}\"><title>{}</title></rect>\n",
      x, y, width, height, color, title);
}

std::string text_at(double x, double y, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\">{}</text>\n", x, y, text);
}

// A bar of colours from `low` to `high`.
std::string scale_bar(double y, double width, const std::string& low, const std::string& high) {
  std::string svg;
  constexpr int steps = 40;
  for (int i = 0; i < steps; ++i)
    svg += square(i * width / steps, y, width / steps + 0.5, 10, color_of((i + 0.5) / steps), "");
  return svg + text_at(0, y + 22, low) +
         text_at(width - 7.0 * static_cast<double>(high.size()), y + 22, high);
}

std::string figure(const std::string& svg, double width, double height, const std::string& caption) {
  return fmt::format(
      "<figure><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
      "{0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n{2}</svg><figcaption>{3}</figcaption></figure>\n",
      width, height, svg, caption);
}

// Where the area's sensors lie, as they are seen against their normals.
struct Plan {
  std::vector<std::size_t> sensors;
  std::vector<std::array<double, 2>> at;
  double low[2] = {}, high[2] = {}, step[2] = {1, 1};

  explicit Plan(const YearReport& r) {
    Vector3d normal;
    for (std::size_t s = 0; s < r.sensors.size(); ++s)
      if (r.in_area[s]) sensors.push_back(s), normal = normal + r.sensors[s].normal;
    int along = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(normal[axis]) > std::abs(normal[along])) along = axis;
    const int across = along == 0 ? 1 : 0, up = along == 2 ? 1 : 2;
    for (const std::size_t s : sensors) {
      const Point3d p = r.sensors[s].position;
      at.push_back({p[across], p[up]});
    }
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = i + 1; j < std::min(at.size(), i + 400); ++j) {
        const double d2 = std::pow(at[i][0] - at[j][0], 2) + std::pow(at[i][1] - at[j][1], 2);
        if (d2 > 0) nearest2 = std::min(nearest2, d2);
      }
    if (std::isfinite(nearest2)) set_steps(std::sqrt(nearest2));
    for (int axis = 0; axis < 2; ++axis) {
      const auto place = static_cast<std::size_t>(axis);
      low[axis] = std::numeric_limits<double>::infinity(), high[axis] = -low[axis];
      for (const auto& p : at)
        low[axis] = std::min(low[axis], p[place]), high[axis] = std::max(high[axis], p[place]);
      low[axis] -= step[axis] / 2, high[axis] += step[axis] / 2;
    }
  }

  // How wide and how high a cell is: of a grid the distances of its columns and rows.
  void set_steps(double nearest) {
    for (const int axis : {0, 1}) {
      const auto place = static_cast<std::size_t>(axis);
      std::vector<double> along;
      for (const auto& p : at) along.push_back(p[place]);
      std::ranges::sort(along);
      step[axis] = 4 * nearest;  // cells of one row are no longer than that
      for (std::size_t i = 1; i < along.size(); ++i)
        if (const double apart = along[i] - along[i - 1]; apart > nearest / 2)
          step[axis] = std::min(step[axis], apart);
      if (along.back() - along.front() < nearest / 2) step[axis] = nearest;
    }
  }
};

std::string map_of(const YearReport& r, const Plan& plan, Figure f, double most, const std::string& caption,
                   const std::function<std::string(double)>& words) {
  constexpr double longest = 300;
  const double size = std::max(plan.high[0] - plan.low[0], plan.high[1] - plan.low[1]);
  const double unit = longest / size, width = (plan.high[0] - plan.low[0]) * unit,
               height = (plan.high[1] - plan.low[1]) * unit;
  std::string svg;
  for (std::size_t i = 0; i < plan.sensors.size(); ++i) {
    const YearEstimate e = r.sensor_years[plan.sensors[i]].estimate(f);
    svg += square((plan.at[i][0] - plan.step[0] / 2 - plan.low[0]) * unit,
                  (plan.high[1] - plan.at[i][1] - plan.step[1] / 2) * unit, plan.step[0] * unit,
                  plan.step[1] * unit, color_of(e.value / most),
                  fmt::format("sensor {}: {}", plan.sensors[i] + 1, words(e.value)));
  }
  const double wide = std::max(width, 160.0);
  return figure(svg + scale_bar(height + 8, wide, "0", words(most)), wide, height + 34, caption);
}

// The mean of the area by month and hour of the day.
std::string months_and_hours(const YearReport& r) {
  std::array<std::array<double, 24>, 12> sums{}, counts{};
  for (std::size_t h = 0; h < r.year.hours.size(); ++h) {
    const auto month = static_cast<std::size_t>(r.year.hours[h].middle.month - 1),
               hour = static_cast<std::size_t>(r.year.hours[h].clock_hour());
    for (std::size_t s = 0; s < r.sensor_years.size(); ++s)
      if (r.in_area[s])
        sums[month][hour] += static_cast<double>(r.sensor_years[s].lux[h]), counts[month][hour] += 1;
  }
  double most = 1;
  for (std::size_t m = 0; m < 12; ++m)
    for (std::size_t h = 0; h < 24; ++h)
      if (counts[m][h] > 0) most = std::max(most, sums[m][h] /= counts[m][h]);
  std::string svg;
  for (std::size_t m = 0; m < 12; ++m)
    for (std::size_t h = 0; h < 24; ++h)
      svg += square(22.0 + 24.0 * static_cast<double>(m), 12.0 * static_cast<double>(23 - h), 24, 12,
                    color_of(std::sqrt(sums[m][h] / most)),
                    fmt::format("month {}, {}:00: {:.0f} lx", m + 1, h, sums[m][h]));
  for (std::size_t h = 0; h < 24; h += 6)
    svg += text_at(0, 12.0 * static_cast<double>(24 - h), fmt::format("{}h", h));
  for (std::size_t m = 0; m < 12; ++m)
    svg += text_at(28.0 + 24.0 * static_cast<double>(m), 300, std::to_string(m + 1));
  return figure(svg + scale_bar(310, 310, "0", fmt::format("{:.0f} lx", most)), 320, 336,
                "Mean illuminance of the area by month and hour; the scale is that of the square root");
}

std::string head_of(const YearReport& r) {
  const auto hours_with = [&](auto of) { return std::ranges::count_if(r.year.hours, of); };
  std::string text = fmt::format(
      "<!doctype html><html lang=en><meta charset=utf-8><title>Daylight over a "
      "year</title><style>{}{}</style>\n"
      "<h1>Daylight over a year</h1>\n<table class=words>\n"
      "<tr><td>Room<td>{}</tr>\n<tr><td>Weather<td>{}, at {:.2f}°, {:.2f}°: {} hours, {} of them by day, {} "
      "with "
      "sun{}</tr>\n<tr><td>Hours of use<td>{}:00 to {}:00</tr>\n<tr><td>Sensors<td>{}, of which {} are "
      "counted as "
      "the area</tr>\n<tr><td>Sky<td>Perez's all-weather sky in {} patches, the sun where it stands in the "
      "middle of each hour</tr>\n<tr><td>Command<td><code>{}</code></tr>\n</table>\n",
      report_style, style, escaped(r.bundle), escaped(r.weather), r.place.latitude_deg, r.place.longitude_deg,
      r.year.hours.size(), hours_with([](const YearHour& h) { return h.sky.has_value(); }),
      hours_with([](const YearHour& h) { return h.sun.has_value(); }),
      (r.missing_hours > 0 ? fmt::format("; {} without measurements count as dark", r.missing_hours) : "") +
          (is_whole_year(r.year) ? "" : "; they are no year, and the figures are of these hours alone"),
      r.settings.first_hour, r.settings.last_hour, r.sensors.size(), std::ranges::count(r.in_area, true),
      r.year.patches - 1, escaped(r.command));
  if (r.state_names.size() < 2) return text;
  text += "<h2>States of the glass</h2>\n<table><tr><th>state<th>hours of use</tr>\n";
  for (std::size_t state = 0; state < r.state_names.size(); ++state) {
    std::size_t hours = 0;
    for (std::size_t h = 0; h < r.states.of_hours.size(); ++h)
      hours += r.states.of_hours[h] == state && r.counted.use[h];
    text += fmt::format("<tr><td>{}<td>{}</tr>\n", escaped(r.state_names[state]), hours);
  }
  return text + "</table>\n";
}

std::string area_of(const YearReport& r) {
  std::string text = "<h2>The area</h2>\n<table class=words><tr><th>figure<th>of the area<th>meaning</tr>\n";
  for (const AreaRow& row : area_rows(r))
    text += fmt::format("<tr><td>{}<td>{:.1f} ± {:.1f} %<td>{}</tr>\n", escaped(row.name),
                        100 * row.estimate.value, 100 * row.estimate.error, escaped(row.words));
  std::string reached = "below the minimum", by_factor = reached;
  for (const AreaFigures::Level& level : r.area.provision) {
    if (level.holds()) reached = fmt::format("of the level <b>{}</b>", level.name);
    if (level.holds_by_factor()) by_factor = fmt::format("of the level <b>{}</b>", level.name);
  }
  return text + "</table>\n<p>Daylight provision (EN 17037:2018, method 2) is " + reached +
         "; by daylight factors (method 1) it is " + by_factor +
         ". Behind ± is the standard error of what was traced; the weather and the model have their "
         "own.</p>\n";
}

std::string heat_of(const YearReport& r) {
  if (!r.heat) return "";
  return fmt::format(
      "<h2>Solar heat</h2>\n<p>Sun and sky bring {:.1f} ± {:.1f} kWh/m² of glass into the room, by the "
      "weather's W/m² and the glass's SHGC at each angle (heat.csv).</p>\n",
      r.heat->year_kwh.value, r.heat->year_kwh.error);
}

std::string sunlight_of(const YearReport& r) {
  if (!sunniest(r)) return "";
  std::string text = fmt::format(
      "<h2>Sunlight</h2>\n<p>Exposure to sunlight (EN 17037:2018) on {}, as if there were no clouds: minutes "
      "in which the sun, higher than {:g}°, shines on a sensor that does not face up. 1.5 h are the minimum, "
      "3 h medium, 4 h high. It is exact to two minutes each time that the sun comes or goes.</p>\n"
      "<table><tr><th>sensor<th>hours<th>level</tr>\n",
      r.sun_day, r.sun_above_deg);
  for (std::size_t s = 0; s < r.sunlight_h.size(); ++s) {
    const std::string_view level = sunlight_level(r.sunlight_h[s]);
    if (!r.in_area[s])
      text += fmt::format("<tr><td>{}<td>{:.2f}<td>{}</tr>\n", s + 1, r.sunlight_h[s],
                          level.empty() ? "none" : level);
  }
  return text + "</table>\n";
}

std::string maps_of(const YearReport& r) {
  if (std::ranges::none_of(r.in_area, [](bool in) { return in; })) return "";
  const Plan plan(r);
  const auto percent = [](double share) { return fmt::format("{:.0f} %", 100 * share); };
  const auto hours = [](double n) { return fmt::format("{:.0f} h", n); };
  const auto lx = [](double value) { return fmt::format("{:.0f} lx", value); };
  double most_lx = 1, most_hours = 250;
  for (const std::size_t s : plan.sensors) {
    most_lx = std::max(most_lx, r.sensor_years[s].estimate(Figure::mean_lx).value);
    most_hours = std::max(most_hours, r.sensor_years[s].estimate(Figure::sun_hours).value);
  }
  return "<h2>Where</h2>\n" +
         map_of(r, plan, Figure::autonomy, 1, fmt::format("DA {:g} lx", r.settings.target_lx), percent) +
         map_of(r, plan, Figure::useful_enough, 1, "UDI, 300 to 3000 lx", percent) +
         map_of(r, plan, Figure::daylight_300, 1, "EN 17037: share of the daylight hours with 300 lx",
                percent) +
         map_of(r, plan, Figure::sun_hours, most_hours, "Hours of use with 1000 lx of the sun alone", hours) +
         map_of(r, plan, Figure::mean_lx, most_lx, "Mean illuminance in the hours of use", lx) +
         "<h2>When</h2>\n" + months_and_hours(r);
}

std::string legend_of(const YearReport& r) {
  std::string text = "<h2>What the columns of figures.csv are</h2>\n<table class=words>\n";
  for (const FigureKind& kind : figure_kinds())
    text += fmt::format("<tr><td>{}<td>{}</tr>\n", kind.name, kind.words);
  return text +
         fmt::format(
             "</table>\n<p>The target is {:g} lx. The daylight hours of EN 17037 are the half of all hours "
             "in which "
             "the sky gives most light on the ground. sDA and ASE are those of IES LM-83{}. hours.csv has "
             "the illuminance of each hour, hours-error.csv its standard "
             "error.</p>\n",
             r.settings.target_lx,
             r.blinds_move
                 ? ": blinds are closed in the hours in which more than 2 % of the area would have more "
                   "than 1000 lx of the sun alone through them. ASE counts with open blinds"
                 : ", but that blinds do not move");
}

}  // namespace

void write_page(const std::filesystem::path& folder, const YearReport& report) {
  write_whole(folder / "index.html", head_of(report) + area_of(report) + sunlight_of(report) +
                                         heat_of(report) + maps_of(report) + legend_of(report) + "</html>\n");
}

}  // namespace vitrail
