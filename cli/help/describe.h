// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/help/command.h"

namespace vitrail {

// Returns what `app`, named "vitrail VERB", declares, but for hidden options (their group is ""). Values and
// headings are as headings.h has them, examples as verbs.h.
Command describe(const CLI::App& app);

// Makes the last value count of an option that takes one, from now on.
void let_the_last_count(CLI::App& app);

}  // namespace vitrail
