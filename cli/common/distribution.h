// SPDX-License-Identifier: Apache-2.0
// How domains are shared out among ranks: what `render` and `plan` have in common.
#pragma once

#include <CLI/CLI.hpp>

#include "farm/scheduler/residency.h"

namespace vitrail {

// `homes`: a profile; `stay`: set in its place by the word bytes.
void declare_distribution(CLI::App& app, Distribution& distribution, std::filesystem::path& homes,
                          bool& stay);

}  // namespace vitrail
