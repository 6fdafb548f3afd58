// SPDX-License-Identifier: Apache-2.0
#include "cli/common/import_arguments.h"

#include "cli/common/sizes.h"
#include "scene/system/input_files.h"

namespace vitrail {

void declare_import_options(CLI::App& app, ImportArguments& a) {
  app.add_option("-D,--define", a.definitions,
                 "name=value: set a parameter of a Mitsuba scene; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& word) {
        const std::size_t at = word.find('=');
        return at == std::string::npos || at == 0 ? "takes name=value, not '" + word + "'" : std::string();
      });
  app.add_option("--camera", a.camera, "which sensor of a Mitsuba scene, or camera of a glTF, from 0")
      ->check(CLI::Range(0, 999'999))
      ->capture_default_str();
  app.add_option("--missing", a.missing,
                 "if files of the scene are missing: refuse the scene, or replace images by grey and leave "
                 "out meshes")
      ->check(CLI::IsMember({"refuse", "replace"}))
      ->capture_default_str();
  app.add_option("--sky", a.sky,
                 "replace all light from infinitely far by the clear sky and sun: "
                 "LATITUDE,LONGITUDE,TIME[,turbidity=3,albedo=0.2,up=y,north=-z,sun=1,sky=1], TIME as "
                 "2026-06-21T12:00+02:00; default of up: the camera's");
  app.add_option("--include-limit", a.include_limit,
                 "most text, in all, of files that a scene includes more than once (default: 1G)");
  app.add_option("--root", a.root, "the scene may name only files in this folder, links resolved");
  app.add_flag("--all-media", a.all_media,
               "keep fog and absorption that the scene's integrator ignores, such as pbrt's \"path\"");
}

void declare_rgb_option(CLI::App& app, std::string& method) {
  app.add_option(
         "--rgb", method,
         "how RGB colours become spectra: smooth (Jakob and Hanika) or by Matrix-R (Cohen and Kappauf)")
      ->check(CLI::IsMember({usual_rgb, "matrix-r"}))
      ->capture_default_str();
}

RgbMethod rgb_method(const std::string& method) {
  return method == usual_rgb ? RgbMethod::jakob_hanika : RgbMethod::matrix_r;
}

ImportOptions import_options(const ImportArguments& a) {
  ImportOptions options{{}, a.missing == "replace", a.sky, a.camera};
  options.all_media = a.all_media;
  for (const std::string& word : a.definitions) {
    const std::size_t at = word.find('=');
    options.definitions[word.substr(0, at)] = word.substr(at + 1);
  }
  if (!a.include_limit.empty()) options.include_limit = parse_bytes(a.include_limit);
  if (!a.root.empty()) confine_inputs(a.root);
  return options;
}

std::vector<std::string> arguments_of(const ImportArguments& a) {
  std::vector<std::string> words;
  for (const std::string& definition : a.definitions) words.insert(words.end(), {"-D", definition});
  if (a.camera != 0) words.insert(words.end(), {"--camera", std::to_string(a.camera)});
  if (a.missing != "refuse") words.push_back("--missing=" + a.missing);
  if (!a.sky.empty()) words.push_back("--sky=" + a.sky);
  if (!a.include_limit.empty()) words.push_back("--include-limit=" + a.include_limit);
  if (!a.root.empty()) words.push_back("--root=" + a.root);
  if (a.all_media) words.push_back("--all-media");
  return words;
}

}  // namespace vitrail
