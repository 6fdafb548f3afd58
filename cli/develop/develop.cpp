// SPDX-License-Identifier: Apache-2.0
// vitrail develop: films become an image. Several films of the same scene with different seeds are merged
// exactly.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "cli/common/input_kind.h"
#include "cli/common/main_guard.h"
#include "cli/common/memory_budget.h"
#include "cli/common/own_output.h"
#include "cli/common/rectangle.h"
#include "cli/develop/chosen_layers.h"
#include "cli/develop/develop_arguments.h"
#include "cli/develop/exposed_films.h"
#include "denoise/denoise_picture.h"
#include "film/alpha.h"
#include "film/cryptomatte.h"
#include "film/false_color.h"
#include "film/group_mix.h"
#include "film/image_io.h"
#include "film/layer_picture.h"
#include "film/own_picture.h"
#include "film/picture_extent.h"
#include "film/sensor_readings.h"
#include "film/tone_curves.h"
#include "film/tone_map.h"
#include "film/white_balance.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/machine_limits.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

using namespace vitrail;

namespace {

// Where the sensors are, as the render wrote it; as many as the film has columns.
nlohmann::json sensors_of(const Exposed& film) {
  const nlohmann::json about = nlohmann::json::parse(film.about, nullptr, false);
  nlohmann::json sensors = about.is_object() ? about.value("sensors", nlohmann::json()) : nlohmann::json();
  if (!sensors.is_array() || sensors.size() != static_cast<std::size_t>(film.film.width()))
    throw Error("a table is made of sensors, and this is a picture: render with --sensors",
                {film.file.string()});
  return sensors;
}

// Where light is found seldom, the error that is told is as uncertain as the mean.
void warn_of_tails(const std::vector<SensorReading>& readings, const nlohmann::json& sensors) {
  constexpr double most = 0.5;
  const auto has_tail = [](const SensorReading& r) { return r.greatest_share > most; };
  const auto first = std::ranges::find_if(readings, has_tail);
  if (first == readings.end()) return;
  const nlohmann::json& at = sensors[static_cast<std::size_t>(first - readings.begin())];
  say("vitrail: the stated error is too small at {} of {} sensors, first at {} {} {}: one in 32 of the "
      "samples makes more than half of the scatter, as light is found seldom and strong. Give more --spp, or "
      "--integrator photon\n",
      std::ranges::count_if(readings, has_tail), readings.size(), at[0].get<double>(), at[1].get<double>(),
      at[2].get<double>());
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
  warn_of_tails(readings, sensors);
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

void say_of_films(const Exposed& sum, const FilmSurvey& whole) {
  if (sum.film.key().clamp > 0)
    say("vitrail: rendered with --clamp {}, which took {:.3g} % of the light\n", sum.film.key().clamp,
        100 * clamped_share(whole, sum.film));
  for (const Layer layer : {Layer::crypto_object, Layer::crypto_material})
    if (const double share = share_without_matte(whole, layer); share > 0)
      say("vitrail: pixels with more than {} masks of {} leave {:.2g} % of the visible surfaces without a "
          "mask\n",
          most_mattes, kind_of(layer).name, 100 * share);
}

// Of films, or of some of their rows.
Picture measured_picture(const Exposed& sum, const Film& rows, const FilmSurvey& whole,
                         const DevelopArguments& a) {
  if (a.with_variance && sum.film.key().one_sequence)
    throw Error("the film knows no variance: it was rendered with --one-sequence", {sum.file.string()});
  Picture picture = develop(rows, whole);
  if (a.groups.empty()) return picture;
  picture.rgb = mixed_groups(rows, parse_group_weights(a.groups));
  std::erase_if(picture.layers, [](const PictureChannel& c) { return c.name.starts_with("Light."); });
  picture.origin.groups = a.groups;
  return picture;
}

void require_parts(const Picture& picture, const DevelopArguments& a) {
  if (a.spectral && picture.spectrum.pixels() == 0)
    throw Error("no spectra are kept here: render with --spectral N", {a.films.front()});
  if (a.with_variance && picture.variance.pixels() == 0)
    throw Error("the picture has no channel Variance.Y", {a.films.front()});
}

// What is asked for beside the colours.
void choose_parts(Picture& picture, const DevelopArguments& a) {
  require_parts(picture, a);
  if (!a.layers.empty()) {
    keep_layers(picture, parse_chosen_layers(a.layers), a.films.front());
    return;
  }
  if (!a.spectral) picture.spectrum = {};
  if (!a.with_variance) picture.variance = {};
}

// `own`: the picture's.
PixelRect cut_of(const PixelRect& own, const DevelopArguments& a) {
  if (a.crop.empty()) return own;
  const PixelRect part = parse_rectangle("--crop", a.crop);
  if (part.x0 >= part.x1 || part.y0 >= part.y1 || part.x0 < own.x0 || part.x1 > own.x1 || part.y0 < own.y0 ||
      part.y1 > own.y1)
    throw UsageError(fmt::format("--crop is not within the picture, which is {},{},{},{}: {}", own.x0, own.x1,
                                 own.y0, own.y1, a.crop));
  return part;
}

void resize_to(Picture& picture, const DevelopArguments& a) {
  if (a.size.empty()) return;
  if (a.with_variance) throw UsageError("--resize mixes pixels, whose variances are then not known");
  if (!picture.mattes.empty() && !a.quiet) say("vitrail: --resize leaves the masks out: ids do not mix\n");
  const auto [width, height] = parse_size("--resize", a.size, {picture.rgb.width, picture.rgb.height});
  resize(picture, width, height);
}

// Returns the stops that the picture was brightened by.
double expose_for_screen(Picture& picture, const DevelopArguments& a) {
  const double ev = exposure_ev(a).value_or(a.exposure == "fit" ? fitting_exposure_ev(picture.rgb)
                                                                : automatic_exposure_ev(picture.rgb));
  expose(picture, ev);
  if (a.white_balance_K > 0) balance_white(picture, a.white_balance_K);
  if (a.tone == "aces") picture.rgb = aces_tone_mapped(picture.rgb);
  if (a.tone == "agx") picture.rgb = agx_tone_mapped(picture.rgb);
  if (a.tone == "filmic") picture.rgb = filmic_tone_mapped(picture.rgb);
  return ev;
}

// `picture`: its first rows; `height`: of all.
void say_what_is_written(const Picture& picture, int height, const DevelopArguments& a, double ev) {
  std::string words = fmt::format("vitrail: {}: {} × {} pixels of {} bits", a.output, picture.rgb.width,
                                  height, a.bits > 0 ? a.bits : usual_bits(a.output));
  if (picture.samples_per_pixel > 0) words += fmt::format(", {} samples each", picture.samples_per_pixel);
  if (!a.layer.empty()) words += ", layer " + a.layer;
  if (!a.groups.empty()) words += ", light " + a.groups;
  if (ev != 0) words += fmt::format(", exposure {:+.2f}", ev);
  if (a.tone != "none") words += ", tone " + a.tone;
  if (!picture.origin.denoiser.empty()) words += ", denoised by " + picture.origin.denoiser;
  say("{}\n", words);
}

// Of films that stay in their files: some of their rows are in memory, and the picture.
Picture picture_of(const Exposed& sum, const FilmSurvey& whole, const DevelopArguments& a) {
  Picture picture;
  const int height = sum.parts[0].height();
  for (MergedRows all(sum, 0, height); const std::optional<Film> rows = all.next();) {
    Picture part = measured_picture(sum, *rows, whole, a);
    choose_parts(part, a);
    append_rows(picture, std::move(part), height);
  }
  tell_origin(picture, sum);
  return picture;
}

// Whether each pixel of what is written is made of that pixel alone.
bool goes_by_rows(const DevelopArguments& a) {
  return a.writes(".exr") && !a.reads_picture() && !a.denoised && a.size.empty() && a.layer.empty() &&
         exposure_ev(a).has_value();
}

// An .exr of films that stay in their files: some of their rows are in memory.
void develop_rows(const Exposed& sum, const FilmSurvey& whole, const DevelopArguments& a) {
  chosen_bits(a.output, a.bits);
  const PixelRect own = sum.parts[0].settings().crop, cut = cut_of(own, a);
  const int height = cut.y1 - cut.y0;
  Picture top;
  double ev = 0;
  std::optional<ExrRows> exr;
  for (MergedRows all(sum, cut.y0 - own.y0, cut.y1 - own.y0); const std::optional<Film> rows = all.next();) {
    Picture picture = measured_picture(sum, *rows, whole, a);
    choose_parts(picture, a);
    cut_to(picture, {cut.x0, cut.x1, picture.window.y0, picture.window.y1});
    ev = expose_for_screen(picture, a);
    if (!exr) {
      tell_origin(picture, sum);
      exr.emplace(a.output, picture, height);
    }
    exr->add(picture);
    if (top.rgb.pixels() == 0) top = std::move(picture);
  }
  exr->commit();
  if (!a.quiet) say_what_is_written(top, height, a, ev);
}

int develop_all(const DevelopArguments& a) {
  for (const std::string& file : a.films) require_input(file, {InputKind::film, InputKind::picture});
  allow_many_files();
  std::optional<Denoiser> denoiser;
  if (a.denoised) denoiser.emplace();
  std::optional<Exposed> sum;
  Picture picture;
  if (a.reads_picture()) {
    picture = read_picture(a.films.front());
    choose_parts(picture, a);
  } else {
    sum = merge_all(a, !a.writes(".csv") && !a.writes(".film"));
    const FilmSurvey whole = survey_of(*sum);
    require_samples(whole.samples, sum->file);
    if (a.writes(".csv")) return write_table(a.output, *sum), exit_done;
    if (a.writes(".film")) return write_merged(a.output, *sum), exit_done;
    if (!a.quiet) say_of_films(*sum, whole);
    if (goes_by_rows(a)) return develop_rows(*sum, whole, a), exit_done;
    picture = picture_of(*sum, whole, a);
  }
  if (!a.layers.empty() && a.denoised) picture.variance = {};  // of what was measured
  if (denoiser) denoise_by_guides(picture, *denoiser, a.quiet);
  cut_to(picture, cut_of(picture.window, a));
  resize_to(picture, a);
  if (!a.layer.empty()) show_layer(picture, a.layer, !a.writes_light());
  if (a.writes(".png")) make_straight(picture);
  const double ev = expose_for_screen(picture, a);
  if (!a.false_color.empty()) show_false_colors(picture, *sum, a);
  write_picture(a.output, picture, a.bits);
  if (!a.quiet) say_what_is_written(picture, picture.rgb.height, a, ev);
  return exit_done;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Turns films into an image; films of different seeds are merged exactly.", "vitrail develop");
  DevelopArguments a;
  declare(app, a);
  return run_guarded(app, argc, argv, [&] {
    require_agreement(a);
    require_place(a.output);
    if (!a.writes(".film")) require_own(a.output, is_own_picture, a.force);
    return within_memory(memory_budget(a.memory, a.quiet), {"developing"}, [&] { return develop_all(a); });
  });
}
