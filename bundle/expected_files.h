// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>

namespace vitrail {

// The domains, objects and textures of a bundle whose manifest cannot be trusted, there or not: those that
// are there and those that must be, since the numbers of files have no gaps, since instances refer to
// objects, and since the manifest, where it is JSON still, lists textures, and domains.bin, where it is
// whole, domains and objects and which of them have no file.
std::set<std::filesystem::path> expected_files(const std::filesystem::path& bundle,
                                               const std::set<std::filesystem::path>& present);

}  // namespace vitrail
