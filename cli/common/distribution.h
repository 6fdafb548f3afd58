// SPDX-License-Identifier: Apache-2.0
// How domains are shared out among ranks: what `render` and `plan` have in common.
#pragma once

#include <CLI/CLI.hpp>

#include "farm/scheduler/residency.h"

namespace vitrail {

void declare_distribution(CLI::App& app, Distribution& distribution, std::filesystem::path& homes);

}  // namespace vitrail
