// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "cli/common/default_output.h"
#include "cli/common/layer_names.h"
#include "cli/common/rectangle.h"
#include "cli/common/sizes.h"
#include "cli/common/switching_glazing.h"
#include "cli/render/display_server.h"
#include "cli/render/quality.h"
#include "film/picture_format.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/terminal.h"

namespace vitrail {

void RenderArguments::name_outputs() {
  if (output.empty()) output = default_output(input);
  JobOutputs& o = options.outputs;
  o.keeps_film = output.extension() == ".film" || !film.empty();
  if (output.extension() != ".film") o.picture = output;
  o.film = behind_links(!film.empty()       ? film
                        : o.picture.empty() ? output
                                            : std::filesystem::path(output) += ".work");
}

bool RenderArguments::is_bundle() const {
  return std::filesystem::exists(input / "manifest.json") || input.extension() == ".vit";
}

void require_renderable(const RenderArguments& a) {
  const std::string name = a.input.string();
  std::error_code unknown;
  if (!std::filesystem::exists(a.input, unknown))
    throw Error(a.is_bundle() ? "there is no such bundle; vitrail partition makes one of a scene"
                              : "there is no such file",
                {name});
  if (a.input.extension() == ".film")
    throw Error("this is a film, which was rendered already: vitrail develop makes a picture of it", {name});
  if (std::filesystem::is_directory(a.input, unknown) && !std::filesystem::exists(a.input / "manifest.json"))
    throw Error("this folder is no bundle: it has no manifest.json", {name});
  if (a.meshes.any() && a.is_bundle())
    throw UsageError("the meshes of a bundle stay as they are: give " + arguments_of(a.meshes)[0] +
                     " to partition");
  ImportArguments imports = a.imports;
  imports.sky.clear(), imports.lamps = "on";  // edits of a bundle
  if (const auto words = arguments_of(imports); !words.empty() && a.is_bundle())
    throw UsageError("a bundle is made already, and its scene is not read again: give " + words[0] +
                     " to partition");
  if (!a.rgb.empty() && a.is_bundle())
    throw UsageError("a bundle is made already, and its scene is not read again: give --rgb to partition");
  if (a.strict && a.is_bundle())
    throw UsageError("a bundle is made already, and its scene is not read again: give --strict to partition");
}

namespace {

void prepare_dry_run(RenderOptions& o) {
  constexpr double long_enough_s = 3;
  o.resources.time_limit_s = long_enough_s;
  o.resources.checkpoint_every_s = 0;
  o.outputs.progress = ProgressMode::none;
  o.outputs.stats.clear(), o.outputs.profile.clear(), o.outputs.trace.clear();
}

TargetError parse_target_error(const std::string& text) {
  constexpr std::string_view unit = "jnd";
  TargetError target;
  target.just_noticeable = text.ends_with(unit);
  const std::string number = target.just_noticeable ? text.substr(0, text.size() - unit.size()) : text;
  const auto [end, failed] = std::from_chars(number.data(), number.data() + number.size(), target.value);
  if (failed != std::errc() || end != number.data() + number.size() || !(target.value > 0) ||
      !std::isfinite(target.value))
    throw UsageError("--target-error takes a number above 0, such as 0.01 or 1jnd: " + text);
  return target;
}

std::uint32_t guiding_layers() {
  FilmLayers layers;
  layers.add(Layer::albedo);
  layers.add(Layer::shading_normal);
  return layers.bits;
}

std::uint32_t alpha_layer() {
  FilmLayers layers;
  layers.add(Layer::alpha);
  return layers.bits;
}

ProgressMode progress_mode(const RenderArguments& a) {
  if (a.progress == "json") return ProgressMode::json;
  if (a.quiet || a.progress == "none") return ProgressMode::none;
  if (a.progress == "auto") return on_terminal() ? ProgressMode::bar : ProgressMode::lines;
  return a.progress == "bar" ? ProgressMode::bar : ProgressMode::lines;
}

// A number is a camera of the scene's own.
void interpret_camera(RenderArguments& a) {
  int number = 0;
  const char* const end = a.camera.data() + a.camera.size();
  const auto [at, failed] = std::from_chars(a.camera.data(), end, number);
  if (failed == std::errc() && at == end && number >= 0)
    a.imports.camera = number;
  else if (!a.camera.empty())
    a.camera_file = a.camera;
}

// --sky and --lamps of a bundle, and --set.
void interpret_edits(RenderArguments& a) {
  PictureSettings& picture = a.options.picture;
  std::vector<std::string> asked;
  if (a.is_bundle() && !a.imports.sky.empty()) {
    picture.edits.push_back(parse_sky_edit(a.imports.sky));
    asked.push_back("sky=" + a.imports.sky);
  }
  for (const std::string& text : a.settings) {
    asked.push_back(text);
    if (is_scene_edit(text))
      picture.edits.push_back(parse_scene_edit(text));
    else
      a.glazing.push_back(text);
  }
  parse_settings(a.glazing);
  if (a.is_bundle() && a.imports.lamps_are_off()) {
    picture.edits.push_back(lamps_off());
    asked.push_back("lamps=off");
  }
  picture.glazing = fmt::format("{}", fmt::join(asked, " "));
}

}  // namespace

void interpret(const CLI::App& app, RenderArguments& a) {
  if (a.frames.empty() && a.range) throw UsageError("--range takes frames of a list: give --frames");
  if (a.frames.empty() && a.retries > 0)
    throw UsageError("--retries is for the frames of a list: give --frames");
  interpret_camera(a);
  require_renderable(a);
  a.name_outputs();
  const std::string extension = a.output.extension().string();
  const PictureFormat format = picture_format(a.output);
  const bool is_picture = format != PictureFormat::none && format != PictureFormat::webp;
  const bool is_table = extension == ".csv" && !a.options.picture.sensors.empty();
  if (!a.options.picture.sensors.empty() && !is_table && extension != ".film")
    throw UsageError("the output of --sensors must end in .csv or .film: " + a.output.string());
  if (!is_table && !is_picture && extension != ".film")
    throw UsageError("the output must end in .exr, .hdr, .png, .jpg, .tif or .film: " + a.output.string());
  if (a.denoised && (is_table || extension == ".film"))
    throw UsageError("--denoise is for pictures, not for .csv and .film: " + a.output.string());
  if (!a.film.empty() && (extension == ".film" || a.film.extension() != ".film"))
    throw UsageError("--film NAME.film keeps the film beside a picture that --output names");
  RenderOptions& o = a.options;
  if (!a.memory.empty()) o.resources.memory_bytes = parse_bytes(a.memory);
  if (!a.crop.empty()) o.picture.crop = parse_rectangle("--crop", a.crop);
  if (a.bins > 0) o.picture.bins = SpectralBins{a.bins};
  if (!a.aov.empty()) o.picture.layers = parse_layers(a.aov).bits;
  if (a.denoised && a.aov.empty()) o.picture.more_layers = guiding_layers();
  if (a.alpha) o.picture.more_layers |= alpha_layer();
  for (const std::string& text : a.light_groups)
    o.picture.light_groups.groups.push_back(parse_light_group(text));
  if (!a.aov_space.empty()) o.picture.layers_in_camera_space = a.aov_space == "camera";
  if (app.count("--max-depth") > 0) o.picture.max_depth = a.max_depth < 0 ? unlimited_depth : a.max_depth;
  if (!a.integrator.empty())
    o.picture.integrator = a.integrator == "direct"   ? Integrator::direct
                           : a.integrator == "photon" ? Integrator::photon
                                                      : Integrator::path;
  o.picture.samples = sample_choices(a.samples);
  if (!a.target_error.empty()) o.picture.target_error = parse_target_error(a.target_error);
  if (!a.quality.empty()) apply_quality(a.quality, app.count("--adaptive") > 0, a.denoised, o);
  o.outputs.progress = progress_mode(a);
  o.outputs.quiet = a.quiet;
  if (o.outputs.dry_run) prepare_dry_run(o);
  interpret_edits(a);
  if (!a.look_at.empty()) o.picture.view.look_at = parse_look_at(a.look_at);
  if (!a.display_server.empty()) parse_display_address(a.display_server);
  o.outputs.scene_name = a.input.string();
}

std::vector<std::string> partition_arguments(const RenderArguments& a) {
  std::vector<std::string> arguments = arguments_of(a.meshes);
  arguments.insert(arguments.end(), {"--no-sync", "--no-summary"});
  // An integrator that is given shows media, whatever the scene's own does; photons do not cross them.
  ImportArguments imports = a.imports;
  imports.all_media |= !a.integrator.empty() && a.integrator != "photon";
  std::ranges::copy(arguments_of(imports), std::back_inserter(arguments));
  if (!a.rgb.empty()) arguments.push_back("--rgb=" + a.rgb);
  arguments.push_back(a.cached ? "--keep-domains" : "--no-cache");
  if (a.quiet) arguments.push_back("--quiet");
  if (a.strict) arguments.push_back("--strict");
  if (!a.aov.empty()) arguments.insert(arguments.end(), {"--aov", a.aov});
  arguments.insert(arguments.end(),
                   {"--progress", a.options.outputs.progress == ProgressMode::bar     ? "bar"
                                  : a.options.outputs.progress == ProgressMode::lines ? "auto"
                                                                                      : "none"});
  // It may have to load what reads images, of more than 100 MiB, and is gone when rendering begins.
  constexpr std::uint64_t least = 256u << 20;
  if (!a.memory.empty())
    arguments.insert(arguments.end(), {"--memory", std::to_string(std::max(parse_bytes(a.memory), least))});
  if (a.options.resources.threads > 0)
    arguments.insert(arguments.end(), {"--threads", std::to_string(a.options.resources.threads)});
  return arguments;
}

}  // namespace vitrail
