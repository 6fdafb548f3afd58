// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/given_sky.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "importers/reading/default_view.h"
#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_distribution.h"
#include "scene/daylight/sky_model.h"
#include "scene/daylight/weather_file.h"
#include "scene/records/light_traits.h"

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

Vector3d axis(const std::string& name) {
  const double sign = name.starts_with('-') ? -1 : 1;
  const std::string letter = name.starts_with('-') || name.starts_with('+') ? name.substr(1) : name;
  if (letter == "x") return {sign, 0, 0};
  if (letter == "y") return {0, sign, 0};
  if (letter == "z") return {0, 0, sign};
  throw UsageError(fmt::format("--sky: expected an axis such as z or -y, found \"{}\"", name));
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

// What is told of a sky that is not the model's clear one.
struct Given {
  std::optional<int> cie;
  std::optional<Measured> direct, diffuse;
};

void set(GivenSky& sky, Given& given, const std::string& key, const std::string& value) {
  if (key == "turbidity")
    sky.light.turbidity = static_cast<float>(number(value, 1, 10));
  else if (key == "albedo")
    sky.light.albedo = ConstantSpectrum{static_cast<float>(number(value, 0, 1))};
  else if (key == "sun")
    sky.light.sun_scale = static_cast<float>(number(value, 0, 1e6));
  else if (key == "sky")
    sky.light.sky_scale = static_cast<float>(number(value, 0, 1e6));
  else if (key == "cie")
    given.cie = cie_type(value);
  else if (key == "direct" || key == "diffuse")
    (key == "direct" ? given.direct : given.diffuse) = measured(key, value);
  else if (key == "up" || key == "north")
    axis(value), (key == "up" ? sky.up : sky.north) = value;
  else
    throw UsageError(
        fmt::format("--sky: there is no \"{}\"; there are turbidity, albedo, cie, diffuse, direct, "
                    "up, north, sun and sky",
                    key));
}

// By the sky's own model where nothing is given of it.
std::optional<MeasuredSky> measured_sky(const GivenSky& sky, const Given& given) {
  const Measured none;
  if (given.direct && !given.diffuse)
    throw UsageError("--sky: direct= is the sun's; diffuse= of the sky has to be there as well");
  if (!given.diffuse) return given.cie ? std::optional(cie_sky(*given.cie, sky.sun, sky.time)) : std::nullopt;
  const Measured diffuse = *given.diffuse, direct = given.direct.value_or(Measured{0, diffuse.in_lux});
  if (direct.in_lux != diffuse.in_lux)
    throw UsageError("--sky: direct= and diffuse= are both in W or both in lx");
  MeasuredSky of =
      (diffuse.in_lux ? perez_sky_of_lux : perez_sky)(direct.value, diffuse.value, sky.sun, sky.time);
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
}

}  // namespace

GivenSky parse_sky(const std::string& words) {
  const std::vector<std::string> parts = parts_of(words);
  GivenSky sky;
  Given given;
  sky.light.albedo = ConstantSpectrum{0.2f};
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
  if (const auto of = measured_sky(sky, given)) {
    take(sky.light, *of);
    sky.is_clear = false;
  }
  return sky;
}

Transform sky_to_world(const std::string& up_name, const std::string& north_name) {
  const Vector3d up = axis(up_name), north = axis(north_name), east = cross(north, up);
  if (!(length(east) > 0))
    throw UsageError(fmt::format("--sky: up={} and north={} are along one axis", up_name, north_name));
  Transform t;
  t.m[0] = {east.x, north.x, up.x, 0};
  t.m[1] = {east.y, north.y, up.y, 0};
  t.m[2] = {east.z, north.z, up.z, 0};
  return t;
}

std::string up_of_camera(const Camera& camera) {
  const Transform to_world = std::visit([](const auto& c) { return c.camera_to_world; }, camera);
  const Vector3d up = normalize(transform_vector(to_world, {0, 1, 0})),
                 right = normalize(transform_vector(to_world, {1, 0, 0}));
  std::string best = "y";
  double most = 0;
  for (const bool level : {true, false}) {
    for (const char* name : {"y", "z", "x", "-y", "-z", "-x"}) {
      const double rises = dot(axis(name), up);
      if (rises > most + 1e-6 && (!level || std::abs(dot(axis(name), right)) < 1e-3))
        most = rises, best = name;
    }
    if (most > 0.1) break;
  }
  return best;
}

namespace {

// cd/m² of surfaces; a point's cd count as if they came from a square decimetre.
double brightness_of(const Scene& scene) {
  double most = 0;
  const auto see = [&](const SpectrumParameter& p, double factor) {
    if (const auto* spectrum = std::get_if<Spectrum>(&p))
      most = std::max(most, photometric(luminance(*spectrum)) * factor);
  };
  for (const AreaLight& light : scene.area_lights) see(light.radiance, 1);
  for (const Light& light : scene.lights) {
    if (const auto* point = std::get_if<PointLight>(&light.model)) see(point->intensity, 100);
    if (const auto* spot = std::get_if<SpotLight>(&light.model)) see(spot->intensity, 100);
  }
  return most;
}

void note_lamps(ImportedScene& imported) {
  constexpr double luminaires = 2e4;
  const double most = brightness_of(imported.scene);
  if (most <= luminaires) return;
  imported.diagnostics.push_back(
      {Fidelity::approximated,
       fmt::format(
           "beside --sky the scene's own lamps count as W/(m2 sr nm): the brightest has {:.2g} cd/m2, the "
           "clear sky some 1e4, a luminaire less; if the scene has units of its own, scale its lamps or "
           "leave them out",
           most)});
}

}  // namespace

void replace_sky(ImportedScene& imported, const GivenSky& sky) {
  Scene& scene = imported.scene;
  // Where there was no light, the scene loses none.
  const bool was_added = std::erase_if(imported.diagnostics, [](const Diagnostic& d) {
                           return d.message == sky_is_added || d.message == sky_is_added_to_lamps;
                         }) > 0;
  std::vector<Light> kept;
  for (Light& light : scene.lights) {
    if (!traits_of(light.model).is_far()) {
      kept.push_back(std::move(light));
      continue;
    }
    if (was_added) continue;
    const SourceLocation place = location(scene, light.origin);
    imported.diagnostics.push_back({Fidelity::dropped, "light from infinitely far: --sky stands for it",
                                    place, place, RecordKind::light});
  }
  scene.lights = std::move(kept);
  const std::string up = sky.up.empty() ? up_of_camera(scene.camera) : sky.up;
  if (sky.up.empty() && up != "y")
    imported.diagnostics.push_back(
        {Fidelity::approximated, fmt::format("--sky: up={} by the camera; with up=… another axis is", up)});
  note_lamps(imported);
  SkyLight light = sky.light;
  const char* usual = up.ends_with('y') ? "-z" : "y";
  light.light_to_world = sky_to_world(up, sky.north.empty() ? usual : sky.north);
  scene.lights.push_back({light, {}});
}

}  // namespace vitrail
