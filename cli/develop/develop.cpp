// SPDX-License-Identifier: Apache-2.0
// vitrail develop: films become an image. Several films of the same scene with different seeds are merged
// exactly.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "cli/common/main_guard.h"
#include "cli/develop/develop_arguments.h"
#include "denoise/denoise_picture.h"
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

Exposed load(const std::string& file, const DevelopArguments& a) {
  note_input(file);
  FilmProgress progress;
  Exposed e{file, read_film(file, &progress), 0, {}, {}};
  e.about = progress.about;
  e.seeds = fmt::format("{}", e.film.key().seed);
  e.render_time_s = progress.render_time_s;
  if (!progress.complete() && a.strict) throw Error("the film is not finished", {file});
  if (!progress.complete() && !a.quiet)
    say("vitrail: {}: the film is not finished; pixels may have unequal numbers of samples\n", file);
  return e;
}

// In the order of their seeds, so that the order on the command line does not matter.
Exposed merge_all(const DevelopArguments& a) {
  std::vector<Exposed> films;
  for (const std::string& file : a.films) films.push_back(load(file, a));
  std::sort(films.begin(), films.end(),
            [](const Exposed& x, const Exposed& y) { return x.film.key().seed < y.film.key().seed; });
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

Picture picture_of(const Exposed& sum) {
  Picture picture = develop(sum.film);
  picture.render_time_s = sum.render_time_s;
  picture.origin.seeds = sum.seeds;
  put_about(picture.origin, sum.about);
  picture.neighbours = neighbours_of(sum.about);
  return picture;
}

void denoise_by_guides(Picture& picture, const Denoiser& denoiser, bool quiet) {
  if (guides_of(picture).albedo.pixels() == 0 && !quiet)
    say("vitrail: no albedo guides the denoiser; films of render --aov albedo,normal have one\n");
  denoise(picture, denoiser);
}

void show_false_colors(Picture& picture, const Exposed& sum, const DevelopArguments& a) {
  const double ratio = sum.film.imaging_ratio();  // of the scene's camera: its exposure is not light
  if (!(ratio > 0)) throw Error("an exposure of 0 leaves no luminances", {sum.file.string()});
  for (float& value : picture.rgb.values) value = static_cast<float>(static_cast<double>(value) / ratio);
  picture.rgb = false_colored(picture.rgb, false_color_of(a));
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
    std::optional<Denoiser> denoiser;
    if (a.denoised) denoiser.emplace();
    const Exposed sum = merge_all(a);
    require_samples(sum.film, sum.file);
    if (a.writes(".csv")) {
      write_table(a.output, sum);
      return exit_done;
    }
    Picture picture = picture_of(sum);
    if (sum.film.key().clamp > 0 && !a.quiet)
      say("vitrail: rendered with --clamp {}, which took {:.3g} % of the light\n", sum.film.key().clamp,
          100 * sum.film.clamped_share());
    if (a.spectral && picture.bins.count == 0)
      throw Error("the film keeps no spectra: render with --spectral N", {sum.file.string()});
    if (!a.spectral) picture.spectrum = {};
    if (a.with_variance && sum.film.key().one_sequence)
      throw Error("the film knows no variance: it was rendered with --one-sequence", {sum.file.string()});
    if (denoiser) denoise_by_guides(picture, *denoiser, a.quiet);
    expose(picture, a.exposure_ev);
    if (a.white_balance_K > 0) balance_white(picture, a.white_balance_K);
    if (!a.with_variance) picture.variance = {};
    if (a.tone == "aces") picture.rgb = aces_tone_mapped(picture.rgb);
    if (!a.false_color.empty()) show_false_colors(picture, sum, a);
    write_picture(a.output, picture, a.bits);
    return exit_done;
  });
}
