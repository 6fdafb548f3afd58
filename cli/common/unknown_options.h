// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vitrail {

// Says of arguments that `app` did not expect which option was perhaps meant, or what another
// renderer's option is called here.
std::string about_unexpected(const CLI::App& app);

}  // namespace vitrail
