// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/help/command.h"

namespace vitrail {

// What `app`, named "vitrail VERB", declares, but for what is hidden (its group is ""). Values and headings
// as headings.h has them, examples as verbs.h.
Command describe(const CLI::App& app);

// From now on the last value counts of an option that takes one.
void let_the_last_count(CLI::App& app);

}  // namespace vitrail
