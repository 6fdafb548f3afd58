// SPDX-License-Identifier: Apache-2.0
#include "cli/develop/develop_arguments.h"

#include <charconv>
#include <cmath>

#include "denoise/denoiser.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {

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
  app.add_flag("--denoise", a.denoised,
               "estimate the noise away by Intel Open Image Denoise, guided by albedo and normals where the "
               "film has them (render --aov albedo,normal); the film stays what it is");
  app.add_flag_callback(
      "--find-denoiser",
      [] {
        show("{}\n", Denoiser().name());
        throw CLI::Success();
      },
      "say which denoiser there is, and nothing else");
  app.add_flag("--strict", a.strict, "refuse films that are not finished");
  app.add_flag("--quiet", a.quiet, "say nothing but what is wrong");
}

void require_agreement(const DevelopArguments& a) {
  const bool is_exr = a.writes(".exr");
  if (a.spectral && !is_exr) throw UsageError("spectra are written as .exr only");
  if (a.tone != "none" && is_exr)
    throw UsageError("--tone is for screens; an .exr holds the light of the scene");
  if (!a.false_color.empty() && (a.tone != "none" || a.exposure_ev != 0 || a.white_balance_K > 0 || is_exr))
    throw UsageError(
        "--false-color shows luminances: not with --tone, --exposure or --white-balance, and not as .exr");
  if (a.denoised && (!a.false_color.empty() || a.with_variance || a.writes(".csv")))
    throw UsageError(
        "--denoise estimates what was not measured: not with --false-color or --variance, and not as .csv");
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
