// SPDX-License-Identifier: Apache-2.0
// This file is the command line of `vitrail compare`.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/flip.h"

namespace vitrail {

struct CompareArguments {
  std::string image, reference, metric = "relmse", variance, mask, flip_range = "auto", memory;
  std::filesystem::path heatmap, signed_map, html;  // empty: none
  std::vector<std::string> ignored;
  std::optional<double> variance_samples, fail_above, mean_within, map_scale;
  double pixels_per_degree = flip_pixels_per_degree;
  std::size_t worst = 3;
  bool resized = false;
  bool json = false, quiet = false, strict = false, force = false;
};

void declare(CLI::App& app, CompareArguments& arguments);

// Returns whether FLIP sees the images as a screen shows them.
bool of_low_range(const CompareArguments& arguments);

}  // namespace vitrail
