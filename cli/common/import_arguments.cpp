// SPDX-License-Identifier: Apache-2.0
#include "cli/common/import_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cli/common/sizes.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

// Why a word is no name with something behind "=".
std::string has_name(const std::string& word, const char* form) {
  const std::size_t at = word.find('=');
  return at == std::string::npos || at == 0 ? fmt::format("takes {}, not '{}'", form, word) : std::string();
}

void declare_program_limits(CLI::App& app, ImportArguments& a) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  constexpr int most_nested = 1000;  // what a stack of 8 MiB holds
  app.add_option("--token-limit", a.program.tokens,
                 "most tokens that a POV-Ray scene may read, counted again in each round of its loops")
      ->check(CLI::Range(std::int64_t{1}, most))
      ->capture_default_str();
  app.add_option("--call-limit", a.program.open_calls,
                 "most macros, loops and files of a POV-Ray scene within each other")
      ->check(CLI::Range(std::int64_t{1}, most))
      ->capture_default_str();
  app.add_option("--nesting-limit", a.program.nested,
                 "most objects, textures and brackets of a POV-Ray scene within each other, up to 1000")
      ->check(CLI::Range(1, most_nested))
      ->capture_default_str();
  app.add_option("--write-limit", a.write_limit,
                 "most text that a POV-Ray scene may write, which is kept in memory (default: 256M)");
}

}  // namespace

void declare_import_options(CLI::App& app, ImportArguments& a) {
  app.add_option(
         "-D,--define", a.definitions,
         "name=value: set a parameter of a Mitsuba scene, or declare a number or text of a POV-Ray scene "
         "(clock=0.5: the time of an animation); may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& word) { return has_name(word, "name=value"); });
  app.add_option("--camera", a.camera,
                 "which sensor of a Mitsuba scene, or camera of a glTF, FBX or COLLADA, from 0")
      ->check(CLI::Range(0, 999'999))
      ->capture_default_str();
  app.add_option("--missing", a.missing,
                 "if files of the scene are missing: refuse the scene, or replace images by grey and leave "
                 "out meshes. OBJ, PLY, FBX, COLLADA and 3DS go on with grey images in any case")
      ->check(CLI::IsMember({"refuse", "replace"}))
      ->capture_default_str();
  app.add_option(
      "--sky", a.sky,
      "replace all light from infinitely far by sky and sun: "
      "LATITUDE,LONGITUDE,TIME[,turbidity=3,ground=0,up=y,north=-z,sun=1,sky=1], TIME as "
      "2026-06-21T12:00+02:00; default of up: the camera's. The sky is clear, or with cie=1 … 15 one "
      "of the CIE's, or with diffuse=210W,direct=640W (or lx) Perez's; paris.epw@06-21T12:00 is an "
      "hour of a weather file (.epw, .wea)");
  app.add_option(
         "--glazing", a.glazing,
         "MATERIAL=FILE: make this material of the scene panes: a system (.json) or a product, as "
         "of vitrail glazing. A surface of it is the whole unit, its front is outside; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& word) { return has_name(word, "MATERIAL=FILE"); });
  app.add_option("--include-limit", a.include_limit,
                 "most text, in all, of files that a scene includes more than once (default: 1G)");
  app.add_option("--include", a.include_folders,
                 "where files of a POV-Ray scene are looked for, after its own folder; may be repeated")
      ->allow_extra_args(false);
  declare_program_limits(app, a);
  app.add_option("--root", a.root, "the scene may name only files in this folder, links resolved");
  app.add_flag("--all-media", a.all_media,
               "keep fog and absorption that the scene's integrator ignores, such as pbrt's \"path\"");
}

void declare_lamps_option(CLI::App& app, ImportArguments& a) {
  app.add_option(
         "--lamps", a.lamps,
         "off: daylight alone. Surfaces, lamps and media of the scene do not shine, and what is off is "
         "reported; light from infinitely far stays")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
}

void declare_rgb_option(CLI::App& app, std::string& method) {
  app.add_option(
         "--rgb", method,
         "how RGB colours become spectra: smooth (Jakob and Hanika), by Matrix-R (Cohen and Kappauf), or "
         "constant in three bands, so that colours multiply as in programs without spectra; by default bands "
         "for POV-Ray's scenes and smooth for all others")
      ->check(CLI::IsMember(std::vector<std::string>(rgb_method_names.begin(), rgb_method_names.end())));
}

RgbMethod rgb_method(const std::string& method) {
  return static_cast<RgbMethod>(std::ranges::find(rgb_method_names, method) - rgb_method_names.begin());
}

ImportOptions import_options(const ImportArguments& a) {
  ImportOptions options{{}, a.missing == "replace", a.sky, a.glazing, a.camera};
  options.all_media = a.all_media;
  for (const std::string& word : a.definitions) {
    const std::size_t at = word.find('=');
    options.definitions[word.substr(0, at)] = word.substr(at + 1);
  }
  if (!a.include_limit.empty()) options.include_limit = parse_bytes(a.include_limit);
  options.include_folders = a.include_folders;
  options.program = a.program;
  if (!a.write_limit.empty()) options.program.written_bytes = parse_bytes(a.write_limit);
  if (!a.root.empty()) confine_inputs(a.root);
  return options;
}

std::vector<std::string> arguments_of(const ImportArguments& a) {
  std::vector<std::string> words;
  for (const std::string& definition : a.definitions) words.insert(words.end(), {"-D", definition});
  if (a.camera != 0) words.insert(words.end(), {"--camera", std::to_string(a.camera)});
  if (a.missing != "refuse") words.push_back("--missing=" + a.missing);
  if (!a.sky.empty()) words.push_back("--sky=" + a.sky);
  for (const std::string& glazing : a.glazing) words.push_back("--glazing=" + glazing);
  if (a.lamps_are_off()) words.push_back("--lamps=off");
  if (!a.include_limit.empty()) words.push_back("--include-limit=" + a.include_limit);
  for (const std::string& folder : a.include_folders) words.push_back("--include=" + folder);
  const ProgramLimits usual;
  if (a.program.tokens != usual.tokens) words.push_back("--token-limit=" + std::to_string(a.program.tokens));
  if (a.program.open_calls != usual.open_calls)
    words.push_back("--call-limit=" + std::to_string(a.program.open_calls));
  if (a.program.nested != usual.nested)
    words.push_back("--nesting-limit=" + std::to_string(a.program.nested));
  if (!a.write_limit.empty()) words.push_back("--write-limit=" + a.write_limit);
  if (!a.root.empty()) words.push_back("--root=" + a.root);
  if (a.all_media) words.push_back("--all-media");
  return words;
}

}  // namespace vitrail
