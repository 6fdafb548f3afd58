// SPDX-License-Identifier: Apache-2.0
// These functions find files by the names that other files say, as people carry them between systems.
#pragma once

#include <filesystem>
#include <string>

namespace vitrail {

// Lowers ASCII letters alone.
char lower_case(char letter);

// Returns the absolute path of a file of `folder` by the name that another file says: as it stands, else with
// the separators of Windows, else its last part alone; each also in other letter cases, as on systems that
// ignore case. Returns "" where there is no such file. An example: "C:\models\Red.png" is red.png in
// `folder`.
std::string find_named_file(std::string name, const std::filesystem::path& folder);

// Returns the same. Where there is no such file it returns the absolute place in `folder` where it would be
// as it stands, so that missing_files.h finds it missing.
std::string named_file(const std::string& name, const std::filesystem::path& folder);

}  // namespace vitrail
