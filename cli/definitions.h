// SPDX-License-Identifier: Apache-2.0
// -D name=value: parameters of a Mitsuba scene.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace vitrail {

// A word that is not name=value is refused as the options are parsed.
void declare_definitions(CLI::App& app, std::vector<std::string>& words);

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& words);

}  // namespace vitrail
