// SPDX-License-Identifier: Apache-2.0
// `render` and `plan` share these options, which say how domains are shared out among ranks.
#pragma once

#include <CLI/CLI.hpp>

#include "farm/scheduler/residency.h"

namespace vitrail {

// `homes` becomes the name of a profile; the word bytes sets `stay` instead.
void declare_distribution(CLI::App& app, Distribution& distribution, std::filesystem::path& homes,
                          bool& stay);

}  // namespace vitrail
