// SPDX-License-Identifier: Apache-2.0
// vitrail develop: films become an image. Several films of the same scene with different seeds are merged
// exactly.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "cli/common/main_guard.h"
#include "film/false_color.h"
#include "film/film_progress.h"
#include "film/image_io.h"
#include "film/sensor_readings.h"
#include "film/tone_map.h"
#include "film/white_balance.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"

using namespace vitrail;

namespace {

struct Exposed {
  std::filesystem::path file;
  Film film;
  double render_time_s = 0;
  std::string about, seeds;
};

struct Manner {
  bool quiet = false, strict = false;
};

struct DevelopArguments {
  std::vector<std::string> films;
  std::string output, tone = "none", false_color;
  double exposure_ev = 0, white_balance_K = 0;
  int bits = 0;
  bool with_variance = false, spectral = false, logarithmic = false;
  Manner manner;

  bool writes(const char* extension) const { return std::filesystem::path(output).extension() == extension; }
};

Exposed load(const std::string& file, const Manner& manner) {
  note_input(file);
  FilmProgress progress;
  Exposed e{file, read_film(file, &progress), 0, {}, {}};
  e.about = progress.about;
  e.seeds = fmt::format("{}", e.film.key().seed);
  e.render_time_s = progress.render_time_s;
  if (!progress.complete() && manner.strict) throw Error("the film is not finished", {file});
  if (!progress.complete() && !manner.quiet)
    say("vitrail: {}: the film is not finished; pixels may have unequal numbers of samples\n", file);
  return e;
}

// In the order of their seeds, so that the order on the command line does not matter.
Exposed merge_all(const std::vector<std::string>& files, const Manner& manner) {
  std::vector<Exposed> films;
  for (const std::string& file : files) films.push_back(load(file, manner));
  std::sort(films.begin(), films.end(),
            [](const Exposed& a, const Exposed& b) { return a.film.key().seed < b.film.key().seed; });
  for (const Exposed& film : films)
    if (const std::string what = difference(films.front().film, film.film); !what.empty())
      throw Error(fmt::format("cannot merge with {}: {}", films.front().file.string(), what),
                  {film.file.string()});
  Exposed sum = std::move(films.front());
  for (std::size_t i = 1; i < films.size(); ++i) {
    if (films[i].film.key().seed == films[i - 1].film.key().seed)
      throw Error(fmt::format("it has seed {}, as {} has: only films of different seeds are independent",
                              films[i].film.key().seed, films[i - 1].file.string()),
                  {films[i].file.string()});
    try {
      sum.film.merge(films[i].film);
    } catch (const Error& e) {
      throw Error(fmt::format("cannot merge with {}: {}", sum.file.string(), e.what()),
                  {films[i].file.string()});
    }
    sum.render_time_s += films[i].render_time_s;
    sum.seeds += "," + films[i].seeds;
  }
  return sum;
}

// What the render knew of scene and camera.
void put_about(PictureOrigin& origin, const std::string& about) {
  const nlohmann::json json = nlohmann::json::parse(about, nullptr, false);
  if (!json.is_object()) return;
  origin.scene = json.value("scene", "");
  origin.glazing = json.value("glazing", "");
  origin.sampling = json.value("sampling", "");
  const auto matrix = [&](const char* name) {
    std::vector<float> numbers;
    if (const auto found = json.find(name); found != json.end() && found->is_array())
      for (const nlohmann::json& number : *found)
        if (number.is_number()) numbers.push_back(number.get<float>());
    return numbers;
  };
  origin.world_to_camera = matrix("world_to_camera");
  origin.world_to_ndc = matrix("world_to_ndc");
}

// "auto" or luminance in cd/m².
FalseColor parse_false_color(const std::string& word, bool logarithmic) {
  FalseColor manner{0, logarithmic};
  if (word == "auto") return manner;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), manner.most);
  if (failed != std::errc() || end != word.data() + word.size() || !(manner.most > 0) ||
      !std::isfinite(manner.most))
    throw UsageError("--false-color takes auto or the luminance of the scale's end in cd/m², above 0: " +
                     word);
  return manner;
}

// Where the sensors are, as the render wrote it; as many as the film has columns.
nlohmann::json sensors_of(const Exposed& film) {
  const nlohmann::json about = nlohmann::json::parse(film.about, nullptr, false);
  const nlohmann::json sensors =
      about.is_object() ? about.value("sensors", nlohmann::json()) : nlohmann::json();
  if (!sensors.is_array() || sensors.size() != static_cast<std::size_t>(film.film.width()))
    throw Error("a table is made of sensors, and this is a picture: render with --sensors",
                {film.file.string()});
  return sensors;
}

void write_table(const std::string& output, const Exposed& film) {
  const nlohmann::json sensors = sensors_of(film);
  std::string text =
      "x,y,z,nx,ny,nz,illuminance_lx,illuminance_error,melanopic_edi_lx,melanopic_edi_error,irradiance_w_m2,"
      "irradiance_error,samples\n";
  const std::vector<SensorReading> readings = sensor_readings(film.film);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (const nlohmann::json& number : sensors[i]) text += fmt::format("{},", number.get<double>());
    for (const Measured& m :
         {readings[i].illuminance_lx, readings[i].melanopic_edi_lx, readings[i].irradiance_w_m2})
      text += fmt::format("{:.6g},{:.3g},", m.mean, m.standard_error);
    text += fmt::format("{}\n", readings[i].samples);
  }
  AtomicFile file(output);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

void declare(CLI::App& app, DevelopArguments& a) {
  app.add_option("FILM", a.films, "films of one scene, each of its own seed")->required();
  app.add_option("-o,--output", a.output,
                 "image to write: .exr (linear), .png, .jpg or .tif (sRGB); .csv of sensors")
      ->required();
  app.add_option("--bits", a.bits, "a channel: 8 or 16; default: 8, and 16 for .tif; .exr has 32")
      ->check(CLI::IsMember({8, 16}));
  app.add_option("--exposure", a.exposure_ev, "brighten by this many stops")->capture_default_str();
  app.add_option(
         "--white-balance", a.white_balance_K,
         "show colours as if they had been under D65 and not under daylight of this temperature in K, "
         "as the `whitebalance` of pbrt's films does")
      ->check(CLI::PositiveNumber);
  app.add_option("--tone", a.tone,
                 "none: what is brighter than white is white; aces: the output transform of ACES 1.x, after "
                 "--exposure; not for .exr")
      ->check(CLI::IsMember({"none", "aces"}))
      ->capture_default_str();
  app.add_option("--false-color", a.false_color,
                 "luminance as colours with a scale, up to this in cd/m², or auto; not for .exr");
  app.add_flag("--log", a.logarithmic, "with --false-color: three decades, by their logarithm");
  app.add_flag("--variance", a.with_variance,
               "add the channel Variance.Y: variance of each pixel's mean luminance");
  app.add_flag("--spectral", a.spectral,
               "add the spectrum of each pixel, for films of render --spectral; .exr only");
  app.add_flag("--strict", a.manner.strict, "refuse films that are not finished");
  app.add_flag("--quiet", a.manner.quiet, "say nothing but what is wrong");
}

// Throws UsageError where options do not go together.
void require_agreement(const DevelopArguments& a) {
  const bool is_exr = a.writes(".exr");
  if (a.spectral && !is_exr) throw UsageError("spectra are written as .exr only");
  if (a.tone != "none" && is_exr)
    throw UsageError("--tone is for screens; an .exr holds the light of the scene");
  if (!a.false_color.empty() && (a.tone != "none" || a.exposure_ev != 0 || a.white_balance_K > 0 || is_exr))
    throw UsageError(
        "--false-color shows luminances: not with --tone, --exposure or --white-balance, and not as .exr");
  if (a.logarithmic && a.false_color.empty()) throw UsageError("--log belongs to --false-color");
}

Picture picture_of(const Exposed& sum) {
  Picture picture = develop(sum.film);
  picture.render_time_s = sum.render_time_s;
  picture.origin.seeds = sum.seeds;
  put_about(picture.origin, sum.about);
  picture.neighbours = neighbours_of(sum.about);
  return picture;
}

void show_false_colors(Picture& picture, const Exposed& sum, const DevelopArguments& a) {
  const double ratio = sum.film.imaging_ratio();  // of the scene's camera: its exposure is not light
  if (!(ratio > 0)) throw Error("an exposure of 0 leaves no luminances", {sum.file.string()});
  for (float& value : picture.rgb.values) value = static_cast<float>(static_cast<double>(value) / ratio);
  picture.rgb = false_colored(picture.rgb, parse_false_color(a.false_color, a.logarithmic));
  picture.window = {0, picture.rgb.width, 0, picture.rgb.height};
  picture.full_width = picture.rgb.width, picture.full_height = picture.rgb.height;
  picture.variance = {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Turns films into an image; films of different seeds are merged exactly.", "vitrail develop");
  DevelopArguments a;
  declare(app, a);
  return run_guarded(app, argc, argv, [&] {
    require_agreement(a);
    require_place(a.output);
    const Exposed sum = merge_all(a.films, a.manner);
    require_samples(sum.film, sum.file);
    if (a.writes(".csv")) {
      write_table(a.output, sum);
      return exit_done;
    }
    Picture picture = picture_of(sum);
    if (sum.film.key().clamp > 0 && !a.manner.quiet)
      say("vitrail: rendered with --clamp {}, which took {:.3g} % of the light\n", sum.film.key().clamp,
          100 * sum.film.clamped_share());
    if (a.spectral && picture.bins.count == 0)
      throw Error("the film keeps no spectra: render with --spectral N", {sum.file.string()});
    if (!a.spectral) picture.spectrum = {};
    if (a.with_variance && sum.film.key().one_sequence)
      throw Error("the film knows no variance: it was rendered with --one-sequence", {sum.file.string()});
    expose(picture, a.exposure_ev);
    if (a.white_balance_K > 0) balance_white(picture, a.white_balance_K);
    if (!a.with_variance) picture.variance = {};
    if (a.tone == "aces") picture.rgb = aces_tone_mapped(picture.rgb);
    if (!a.false_color.empty()) show_false_colors(picture, sum, a);
    write_picture(a.output, picture, a.bits);
    return exit_done;
  });
}
