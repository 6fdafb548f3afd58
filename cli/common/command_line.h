// SPDX-License-Identifier: Apache-2.0
// This file reads a command line as people type it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vitrail {

// Returns the words as CLI11 takes them. "-o=a.png" is "-o a.png", and numbers that an option takes with
// commas may stand apart: "--crop 0 8 -3, 8" is "--crop 0,8,-3,8".
std::vector<std::string> as_parsed(const CLI::App& app, const std::vector<std::string>& typed);

// Says for people what is wrong: "--spp takes a whole number, not 4.5".
std::string about(const CLI::App& app, const CLI::ParseError& error);

}  // namespace vitrail
