// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/given_sky.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_distribution.h"
#include "scene/daylight/sky_model.h"
#include "scene/daylight/weather_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

double number(const std::string& word, double low, double high) {
  double x = 0;
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, word.data() + word.size(), x);
  if (error != std::errc() || end != word.data() + word.size() || !(x >= low && x <= high))
    throw UsageError(
        fmt::format("--sky: expected a number from {:g} to {:g}, found \"{}\"", low, high, word));
  return x;
}

// Degrees, negative ones also as those of the other letter: 33.9S is −33.9.
double degrees(std::string word, char positive, char negative, double most) {
  const char last = word.empty() ? 0 : word.back();
  if (last != positive && last != negative) return number(word, -most, most);
  word.pop_back();
  return number(word, 0, most) * (last == negative ? -1 : 1);
}

// What a key gives of the sun or of the sky.
struct Measured {
  double value = 0;
  bool in_lux = false;
};

Measured measured(const std::string& key, std::string word) {
  Measured of;
  if (word.ends_with("lx"))
    of.in_lux = true, word.resize(word.size() - 2);
  else if (word.ends_with("W"))
    word.pop_back();
  else
    throw UsageError(fmt::format("--sky: {0}={1} has no unit: {0}=210W (W/m2) or {0}=24300lx", key, word));
  of.value = number(word, 0, of.in_lux ? 3e5 : 2000);
  return of;
}

int cie_type(const std::string& word) {
  constexpr std::pair<const char*, int> names[] = {
      {"overcast", 1}, {"uniform", 5}, {"intermediate", 7}, {"clear", 12}};
  for (const auto& [name, type] : names)
    if (word == name) return type;
  const double type = number(word, 1, 15);
  if (type != std::floor(type))
    throw UsageError(fmt::format("--sky: cie={}: a type is whole, 1 to 15", word));
  return static_cast<int>(type);
}

// What is told of a sky that is not the model's clear one, and what of the ground.
struct Given {
  std::optional<int> cie;
  std::optional<double> albedo;
  bool is_of_weather = false, takes_file_lux = false;
  std::optional<WeatherLux> file_lux;
  std::optional<Measured> direct, diffuse;
};

void set(GivenSky& sky, Given& given, const std::string& key, const std::string& value) {
  if (key == "turbidity")
    sky.light.turbidity = static_cast<float>(number(value, 1, 10));
  else if (key == "albedo")
    given.albedo = number(value, 0, 1);
  else if (key == "ground")
    sky.light.ground = static_cast<float>(number(value, 0, 1));
  else if (key == "sun")
    sky.light.sun_scale = static_cast<float>(number(value, 0, 1e6));
  else if (key == "sky")
    sky.light.sky_scale = static_cast<float>(number(value, 0, 1e6));
  else if (key == "cct")
    sky.light.color_temperature_k = static_cast<float>(number(value, 4000, 25000));
  else if (key == "cie")
    given.cie = cie_type(value);
  else if (key == "lux" && (value == "file" || value == "perez"))
    given.takes_file_lux = value == "file";
  else if (key == "direct" || key == "diffuse")
    (key == "direct" ? given.direct : given.diffuse) = measured(key, value);
  else if (key == "up" || key == "north")
    axis_of(value), (key == "up" ? sky.up : sky.north) = value;
  else
    throw UsageError(
        fmt::format("--sky: there is no \"{}\"; there are turbidity, albedo, cct, cie, diffuse, direct, "
                    "ground, lux=file, up, north, sun and sky",
                    key));
}

// By the sky's own model where nothing is given of it.
std::optional<MeasuredSky> measured_sky(const GivenSky& sky, const Given& given) {
  if (given.direct && !given.diffuse)
    throw UsageError("--sky: direct= is the sun's; diffuse= of the sky has to be there as well");
  if (!given.diffuse) return given.cie ? std::optional(cie_sky(*given.cie, sky.sun, sky.time)) : std::nullopt;
  const Measured diffuse = *given.diffuse, direct = given.direct.value_or(Measured{0, diffuse.in_lux});
  if (direct.in_lux != diffuse.in_lux)
    throw UsageError("--sky: direct= and diffuse= are both in W or both in lx");
  MeasuredSky of =
      (diffuse.in_lux ? perez_sky_of_lux : perez_sky)(direct.value, diffuse.value, sky.sun, sky.time);
  if (given.file_lux && given.takes_file_lux) {
    of.distribution.diffuse_lx = given.file_lux->diffuse_horizontal;
    of.direct_normal_lx = sky.sun.elevation_deg > 0 ? given.file_lux->direct_normal : 0;
  }
  if (!given.cie) return of;
  const double lx = of.distribution.diffuse_lx;
  of.distribution = cie_sky(*given.cie, sky.sun, sky.time).distribution;
  of.distribution.diffuse_lx = lx;
  return of;
}

// The sun becomes as bright as it was measured.
void take(SkyLight& light, const MeasuredSky& of) {
  SkyLight sun = light;
  sun.sun_scale = 1;
  const SkyModel model(sun);
  const double natural = photometric(to_xyz(spectrum_of_bands(model.sun_irradiance(model.to_sun()))).y);
  light.sun_scale *= static_cast<float>(natural > 0 ? of.direct_normal_lx / natural : 0);
  *light.distribution = of.distribution;
}

std::vector<std::string> parts_of(const std::string& words) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= words.size();) {
    const std::size_t end = std::min(words.find(',', at), words.size());
    parts.push_back(words.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

bool names_weather(const std::string& word) {
  const std::filesystem::path file = word.substr(0, word.rfind('@'));
  return word.find('@') != word.npos && (file.extension() == ".epw" || file.extension() == ".wea");
}

LocalTime moment_of(const std::string& text) {
  try {
    return local_time(text);
  } catch (const Error& error) {
    throw UsageError(fmt::format("--sky: {}", error.what()));
  }
}

// Of "FILE@MM-DDTHH:MM". February has 29 days: whether the file has that one is seen when it is read.
void set_by_weather(GivenSky& sky, Given& given, const std::string& word) {
  const std::size_t at = word.rfind('@');
  constexpr const char* leap_year = "2024-";
  const WeatherHour hour =
      read_weather_hour(word.substr(0, at), moment_of(leap_year + word.substr(at + 1) + "Z"));
  sky.place = hour.place, sky.time = hour.middle;
  given.direct = Measured{hour.direct_normal_w}, given.diffuse = Measured{hour.diffuse_horizontal_w};
  given.is_of_weather = true, given.file_lux = hour.lux;
}

}  // namespace

GivenSky parse_sky(const std::string& words) {
  const std::vector<std::string> parts = parts_of(words);
  GivenSky sky;
  Given given;
  std::size_t first_key = 1;
  if (names_weather(parts[0])) {
    set_by_weather(sky, given, parts[0]);
  } else {
    if (parts.size() < 3)
      throw UsageError(
          "--sky takes LATITUDE,LONGITUDE,TIME such as 48.85,2.35,2026-06-21T12:00+02:00, or an hour of a "
          "weather file such as paris.epw@06-21T12:00");
    sky.place = {degrees(parts[0], 'N', 'S', 90), degrees(parts[1], 'E', 'W', 180)};
    sky.time = moment_of(parts[2]);
    first_key = 3;
  }
  sky.sun = sun_position(sky.time, sky.place);
  sky.light.to_sun = direction_of(sky.sun);
  std::set<std::string, std::less<>> keys;
  for (std::size_t i = first_key; i < parts.size(); ++i) {
    const std::size_t at = parts[i].find('=');
    const std::string key(at == std::string::npos ? "turbidity" : parts[i].substr(0, at));
    if (!keys.insert(key).second) throw UsageError(fmt::format("--sky: {} is given twice", key));
    set(sky, given, key, at == std::string::npos ? parts[i] : parts[i].substr(at + 1));
  }
  const double albedo =
      given.albedo.value_or(keys.contains("ground") ? static_cast<double>(sky.light.ground) : 0.2);
  sky.light.albedo = ConstantSpectrum{static_cast<float>(albedo)};
  if (given.takes_file_lux && !given.is_of_weather)
    throw UsageError("--sky: lux=file is of an hour of a weather file, such as paris.epw@06-21T12:00");
  if (given.takes_file_lux && !given.file_lux)
    throw Error("the file has no illuminances of this hour: leave out lux=file", {parts[0]});
  if (const auto of = measured_sky(sky, given))
    take(sky.light, *of);
  else if (keys.contains("cct"))
    throw UsageError("--sky: cct= is of a sky with cie= or diffuse=; the clear one has its model's colours");
  return sky;
}

Vector3d axis_of(const std::string& name) {
  const double sign = name.starts_with('-') ? -1 : 1;
  const std::string letter = name.starts_with('-') || name.starts_with('+') ? name.substr(1) : name;
  if (letter == "x") return {sign, 0, 0};
  if (letter == "y") return {0, sign, 0};
  if (letter == "z") return {0, 0, sign};
  throw UsageError(fmt::format("--sky: expected an axis such as z or -y, found \"{}\"", name));
}

}  // namespace vitrail
