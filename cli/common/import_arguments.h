// SPDX-License-Identifier: Apache-2.0
// These options say how a scene is loaded: -D name=value, --camera N, --missing, --sky, --glazing, --lamps,
// --include, --root, --all-media and limits.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "importers/reading/import_options.h"
#include "scene/spectra/rgb_method.h"

namespace vitrail {

struct ImportArguments {
  std::vector<std::string> definitions, glazing;
  int camera = 0;
  std::string missing = "refuse", sky, include_limit, root;
  std::vector<std::string> include_folders;
  ProgramLimits program;
  std::string write_limit;
  bool all_media = false;
  std::string lamps = "on";  // of partition and render alone
  bool lamps_are_off() const { return lamps == "off"; }
};

// Declares --rgb jakob-hanika|matrix-r|bands: how a scene's colours become spectra as it is partitioned. ""
// takes them as the scene's file means them.
void declare_rgb_option(CLI::App& app, std::string& method);
RgbMethod rgb_method(const std::string& method);

// This is the help of --no-cache.
inline constexpr const char* no_cache_help =
    "bake all images without the cache in $XDG_CACHE_HOME/vitrail or ~/.cache/vitrail";

// Declares the options. A definition that is not name=value is refused as they are parsed.
void declare_import_options(CLI::App& app, ImportArguments& arguments);

void declare_lamps_option(CLI::App& app, ImportArguments& arguments);

// Returns the options. What --root allows holds from then on.
ImportOptions import_options(const ImportArguments& arguments);

// Returns the words of a command line that give them again; none for what is as usual.
std::vector<std::string> arguments_of(const ImportArguments& arguments);

}  // namespace vitrail
