// SPDX-License-Identifier: Apache-2.0
// Whether pbrt-v4 would take a file, in place of pbrt itself: its grammar, its parameters (pbrt_table.h), and
// what it refuses or silently leaves out beyond them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::test {

// What is wrong with the file, each with its line; empty where pbrt takes all of it.
std::vector<std::string> pbrt_complaints(const std::filesystem::path& file);
// Of a text; files that it names are looked for in `directory`.
std::vector<std::string> pbrt_complaints(const std::string& text, const std::filesystem::path& directory);

}  // namespace vitrail::test
