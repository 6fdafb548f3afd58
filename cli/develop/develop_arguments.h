// SPDX-License-Identifier: Apache-2.0
// The command line of `vitrail develop`.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "film/false_color.h"

namespace vitrail {

struct DevelopArguments {
  std::vector<std::string> films;
  std::string output, tone = "none", false_color;
  double exposure_ev = 0, white_balance_K = 0;
  int bits = 0;
  bool with_variance = false, spectral = false, logarithmic = false, denoised = false;
  bool quiet = false, strict = false;

  bool writes(const char* extension) const { return std::filesystem::path(output).extension() == extension; }
};

void declare(CLI::App& app, DevelopArguments& arguments);

// Throws UsageError where options do not go together.
void require_agreement(const DevelopArguments& arguments);

// Of --false-color: "auto", or luminance in cd/m². Throws UsageError.
FalseColor false_color_of(const DevelopArguments& arguments);

}  // namespace vitrail
