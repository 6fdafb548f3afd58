// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vitrail {

// What to say of arguments that `app` did not expect: the option that was perhaps meant, or what another
// renderer's option is called here.
std::string about_unexpected(const CLI::App& app);

}  // namespace vitrail
