// SPDX-License-Identifier: Apache-2.0
// This file is the command line of `vitrail develop`.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "film/false_color.h"
#include "film/picture_format.h"

namespace vitrail {

struct DevelopArguments {
  std::vector<std::string> films;
  std::string output, tone = "none", false_color, exposure = "0", crop, size, layer, layers, groups, memory;
  double white_balance_K = 0;
  int bits = 0;
  bool with_variance = false, spectral = false, logarithmic = false, denoised = false;
  bool quiet = false, strict = false, force = false;

  bool writes(const char* extension) const { return std::filesystem::path(output).extension() == extension; }
  bool writes_light() const { return holds_light(picture_format(output)); }
  bool reads_picture() const;  // in place of films
};

void declare(CLI::App& app, DevelopArguments& arguments);

// Throws UsageError where options do not go together.
void require_agreement(const DevelopArguments& arguments);

// Returns the stops of --exposure; none means that the picture decides. Throws UsageError.
std::optional<double> exposure_ev(const DevelopArguments& arguments);

// Returns the scale of --false-color: "auto", or luminance in cd/m². Throws UsageError.
FalseColor false_color_of(const DevelopArguments& arguments);

}  // namespace vitrail
