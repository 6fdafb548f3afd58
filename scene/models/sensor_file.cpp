// SPDX-License-Identifier: Apache-2.0
#include "scene/models/sensor_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

struct Line {
  const std::filesystem::path& file;
  int number;
  std::string text;

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(what, {file.string(), number, 1}, text);
  }

  double value(const std::string& word) const {
    double x = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(x))
      fail(fmt::format("expected a number, found \"{}\"", word));
    return x;
  }
};

Vector3d facing(const Line& line, Vector3d normal) {
  const double size = length(normal);
  if (!(size > 0) || !std::isfinite(size))
    line.fail("a sensor has to face somewhere: its normal has no length");
  return normal * (1 / size);
}

void add(std::vector<Sensor>& sensors, const Line& line, const Sensor& sensor) {
  if (sensors.size() == max_sensors) line.fail(fmt::format("more than {} sensors", max_sensors));
  sensors.push_back(sensor);
}

void add_plane(std::vector<Sensor>& sensors, const Line& line, const std::vector<std::string>& words) {
  if (words.size() != 11) line.fail("expected plane and 9 numbers and NXxNY");
  const auto triple = [&](std::size_t i) {
    return Vector3d{line.value(words[i]), line.value(words[i + 1]), line.value(words[i + 2])};
  };
  const Vector3d o = triple(1), u = triple(4), v = triple(7), normal = facing(line, cross(u, v));
  const std::string& size = words[10];
  const std::size_t by = size.find('x');
  if (by == std::string::npos) line.fail("expected NXxNY, such as 8x5");
  const double nx = line.value(size.substr(0, by)), ny = line.value(size.substr(by + 1));
  const auto is_count = [](double n) { return n >= 1 && n <= 1 << 16 && n == std::floor(n); };
  if (!is_count(nx) || !is_count(ny)) line.fail("a plane has a whole number of sensors either way");
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      const Vector3d p = o + u * ((x + 0.5) / nx) + v * ((y + 0.5) / ny);
      add(sensors, line, {{p.x, p.y, p.z}, normal});
    }
}

}  // namespace

std::vector<Sensor> read_sensors(const std::filesystem::path& file) {
  std::ifstream in = open_input(file);
  if (!in) throw Error("cannot read the sensors", {file.string()});
  std::vector<Sensor> sensors;
  Line line{file, 0, {}};
  while (std::getline(in, line.text)) {
    ++line.number;
    std::istringstream stream(line.text.substr(0, line.text.find('#')));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty()) continue;
    if (words[0] == "plane") {
      add_plane(sensors, line, words);
      continue;
    }
    if (words.size() != 6) line.fail("expected x y z nx ny nz");
    std::array<double, 6> n{};
    for (std::size_t i = 0; i < 6; ++i) n[i] = line.value(words[i]);
    add(sensors, line, {{n[0], n[1], n[2]}, facing(line, {n[3], n[4], n[5]})});
  }
  if (sensors.empty()) throw Error("there is no sensor in it", {file.string()});
  return sensors;
}

FilmSettings sensor_film(std::size_t sensors) {
  FilmSettings film;
  film.width = static_cast<int>(sensors);
  film.height = sensor_rows;
  film.crop = {0, film.width, 0, film.height};
  film.filter = BoxFilter{};
  film.imaging_ratio = std::numbers::pi;
  film.spectrum.count = 47;  // 10 nm
  return film;
}

}  // namespace vitrail
