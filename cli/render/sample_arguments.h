// SPDX-License-Identifier: Apache-2.0
// These options say how a picture is sampled.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "farm/plan/sample_choices.h"

namespace vitrail {

struct SampleArguments {
  std::string filter, texture_filter, roulette = "default", light_sampling = "tree";
  bool splat = false, one_sequence = false;
  int wavelengths = 4;
  std::uint32_t light_candidates = SamplingChoices{}.light_candidates;
};

void declare_sample_options(CLI::App& app, SampleArguments& arguments);

// Throws UsageError.
SampleChoices sample_choices(const SampleArguments& arguments);

}  // namespace vitrail
