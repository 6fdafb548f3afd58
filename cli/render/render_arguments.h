// SPDX-License-Identifier: Apache-2.0
// This file is the command line of `vitrail render`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "cli/common/import_arguments.h"
#include "cli/common/mesh_options.h"
#include "cli/render/sample_arguments.h"
#include "farm/plan/options.h"

namespace vitrail {

struct RenderArguments {
  std::filesystem::path input, output, film, frames, camera_file;
  std::optional<std::string> range;  // of frames; empty: all
  int retries = 0;                   // of those that fail
  std::filesystem::path held_lock;  // while frames are rendered, for the process that supervises; empty: none
  int bins = 0, max_depth = 0;
  std::string memory, crop, integrator, aov, aov_space, camera, look_at, target_error, quality,
      progress = "auto";
  std::vector<std::string> settings;      // of --set
  std::vector<std::string> glazing;       // those of them that are of switchable glazing
  std::vector<std::string> light_groups;  // of --light-group
  bool alpha = false, quiet = false, strict = false, denoised = false, cached = true;
  ImportArguments imports;
  std::string rgb;
  MeshOptions meshes;
  SampleArguments samples;
  RenderOptions options;
  int restarts = 0;
  std::string launcher;  // empty: this process alone
  std::filesystem::path preview;
  std::string display_server;  // HOST:PORT; empty: none

  bool is_bundle() const;
  void name_outputs();  // the picture where the user names none, and its film or work file
};

void declare(CLI::App& app, RenderArguments& arguments);

// Throws Error where there is no such bundle or scene, and UsageError for options that a
// bundle does not have.
void require_renderable(const RenderArguments& arguments);

// Fills in `options`, but for the bundle of a scene that is yet to be made. Throws UsageError, and Error
// where the input is not what can be rendered.
void interpret(const CLI::App& app, RenderArguments& arguments);

// Returns the arguments of the program that makes the bundle of a scene.
std::vector<std::string> partition_arguments(const RenderArguments& arguments);

}  // namespace vitrail
