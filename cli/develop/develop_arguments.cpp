// SPDX-License-Identifier: Apache-2.0
#include "cli/develop/develop_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cli/common/memory_budget.h"
#include "cli/develop/chosen_layers.h"
#include "denoise/denoiser.h"
#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

std::string layout_in_words(const std::string& picture) {
  try {
    const ImageLayout layout = read_image_layout(picture);
    read_stored_rows(picture, [](const StoredImage&) {});
    return fmt::format("{} {} {}", layout.width, layout.height, layout.channels);
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace

void declare(CLI::App& app, DevelopArguments& a) {
  app.add_option("FILM", a.films,
                 "films of one scene, each of its own seed; or an .exr or .hdr in their place")
      ->required();
  app.add_option("-o,--output", a.output,
                 "image to write: .exr or .hdr (linear), .png, .jpg, .tif or .webp (sRGB); .csv of sensors; "
                 ".film: the films as one")
      ->required();
  app.add_option("--bits", a.bits, "bits a channel; default: 8, for .tif 16; .exr and .hdr have 32")
      ->check(CLI::IsMember({8, 16}));
  app.add_option("--crop", a.crop, "x0,x1,y0,y1 in pixels from the whole picture's top left");
  app.add_option(
      "--resize", a.size,
      "resize to WIDTHxHEIGHT in pixels, to a WIDTH with the height in proportion, or to PERCENT%");
  app.add_option("--layer", a.layer,
                 "show this layer of the first surfaces, as render --aov names it, in place of the colours");
  app.add_option("--layers", a.layers,
                 "the layers of an .exr beside the colours, separated by commas: all (of the film), names of "
                 "render --aov, variance, spectrum, groups; default: all but variance and spectrum");
  app.add_option("--groups,--group", a.groups,
                 "NAME=WEIGHT,…: weigh the light of these groups of a film of render --light-groups. A "
                 "weight is a number or red:green:blue; * means all groups, and other groups have 1");
  app.add_option(
         "--exposure", a.exposure,
         "brighten by this many stops; auto: the log-average of the luminances becomes 0.18; fit: as auto "
         "where most of the picture would be far above white, else 0. A render makes its picture with fit")
      ->capture_default_str();
  app.add_option("--white-balance", a.white_balance_K,
                 "show colours under daylight of this temperature in K as they would be under D65; the same "
                 "as `whitebalance` of pbrt's films")
      ->check(CLI::PositiveNumber);
  app.add_option("--tone", a.tone,
                 "none: all colours above white become white; aces: the output transform of ACES 1.x; agx: "
                 "Sobotka's AgX, where bright colours pale; filmic: Hable's curve. It follows --exposure; "
                 ".exr and .hdr have none")
      ->check(CLI::IsMember({"none", "aces", "agx", "filmic"}))
      ->capture_default_str();
  app.add_option("--false-color", a.false_color,
                 "show luminance as colours with a scale, up to this value in cd/m², or auto; not for .exr");
  app.add_flag("--log", a.logarithmic, "with --false-color: three decades on a logarithmic scale");
  app.add_flag("--variance", a.with_variance,
               "add the channel Variance.Y: variance of each pixel's mean luminance");
  app.add_flag("--spectral", a.spectral,
               "add the spectrum of each pixel, for films of render --spectral; .exr only");
  app.add_flag("--denoise", a.denoised,
               "remove noise with Intel Open Image Denoise, guided by albedo and normals if the film has "
               "them (render --aov albedo,normal). The film does not change");
  app.add_flag_callback(
      "--find-denoiser",
      [] {
        show("{}\n", Denoiser().name());
        throw CLI::Success();
      },
      "print which denoiser is found, and end");
  // For render --frames: decodes all of a picture, and prints its width, height and channels, or why not.
  app.add_option_function<std::string>("--layout-of",
                                       [](const std::string& picture) {
                                         show("{}\n", layout_in_words(picture));
                                         throw CLI::Success();
                                       })
      ->group("");
  app.add_flag("--force", a.force,
               "replace a file that does not say that vitrail made it, as a .webp never does");
  declare_memory(app, a.memory);
  app.add_flag("--strict", a.strict, "refuse films that are not finished");
  app.add_flag("--quiet", a.quiet, "print problems only");
}

bool DevelopArguments::reads_picture() const {
  return std::ranges::any_of(
      films, [](const std::filesystem::path& file) { return holds_light(picture_format(file)); });
}

std::optional<double> exposure_ev(const DevelopArguments& a) {
  if (a.exposure == "auto" || a.exposure == "fit") return std::nullopt;
  double ev = 0;
  const char* const end_of_word = a.exposure.data() + a.exposure.size();
  const auto [end, failed] =
      std::from_chars(a.exposure.data() + a.exposure.starts_with('+'), end_of_word, ev);
  if (failed != std::errc() || end != end_of_word || !std::isfinite(ev))
    throw UsageError("--exposure takes auto, fit or a number of stops, such as 1 or -0.5: " + a.exposure);
  return ev;
}

void require_agreement(const DevelopArguments& a) {
  if (a.spectral && !a.writes(".exr")) throw UsageError("spectra are written as .exr only");
  if (a.tone != "none" && a.writes_light())
    throw UsageError("--tone is for screens; an .exr or .hdr holds the light of the scene");
  const bool is_exposed = a.tone != "none" || exposure_ev(a) != 0.0 || a.white_balance_K > 0;
  if (!a.false_color.empty() && (is_exposed || a.writes_light()))
    throw UsageError(
        "--false-color shows luminances: not with --tone, --exposure or --white-balance, and not as .exr");
  if (a.denoised && (!a.false_color.empty() || a.with_variance || a.writes(".csv")))
    throw UsageError("--denoise changes measurements: not with --false-color or --variance, and not as .csv");
  if (!a.layer.empty() &&
      (is_exposed || a.denoised || a.with_variance || a.spectral || !a.false_color.empty()))
    throw UsageError("--layer shows numbers as they are: only --crop, --resize and --bits go with it");
  if (!a.layers.empty() && (!a.writes(".exr") || !a.layer.empty() || a.with_variance || a.spectral))
    throw UsageError("--layers chooses the layers of an .exr: leave out --layer, --variance and --spectral");
  const ChosenLayers chosen = parse_chosen_layers(a.layers);
  if (chosen.variance && (a.denoised || !a.size.empty()))
    throw UsageError("--denoise and --resize give no variance: leave out one of them, or the layer variance");
  if (!a.groups.empty() && (chosen.groups || a.with_variance || a.spectral || !a.layer.empty() ||
                            a.writes(".csv") || a.writes(".film") || a.reads_picture()))
    throw UsageError(
        "--groups weighs the colours that a film keeps: not with --variance, --spectral or --layer, not as "
        ".csv or .film, and not of pictures");
  if (a.reads_picture() && a.films.size() > 1)
    throw UsageError("pictures do not merge as films do: give one");
  if (a.reads_picture() && (a.writes(".csv") || a.writes(".film") || !a.false_color.empty()))
    throw UsageError("a picture is no film: .csv, .film and --false-color need the measurements of a film");
  if (a.writes(".film") && (is_exposed || a.denoised || a.with_variance || a.spectral || a.bits > 0 ||
                            !a.false_color.empty() || !a.layer.empty() || !a.crop.empty() || !a.size.empty()))
    throw UsageError("a .film holds the samples of its render: no option changes it");
  if (a.logarithmic && a.false_color.empty()) throw UsageError("--log belongs to --false-color");
}

FalseColor false_color_of(const DevelopArguments& a) {
  const std::string& word = a.false_color;
  FalseColor manner{0, a.logarithmic};
  if (word == "auto") return manner;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), manner.most);
  if (failed != std::errc() || end != word.data() + word.size() || !(manner.most > 0) ||
      !std::isfinite(manner.most))
    throw UsageError("--false-color takes auto or the luminance of the scale's end in cd/m², above 0: " +
                     word);
  return manner;
}

}  // namespace vitrail
