// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>

namespace vitrail {

// Returns the domain, object and texture files that there should be where the manifest cannot be trusted. It
// has those that are present, and those that fill gaps in their numbers or that instances refer to. Where the
// manifest is still JSON, it has the textures that are listed there. Where domains.bin is whole, it has the
// domains and objects listed there, but for those without a file.
std::set<std::filesystem::path> expected_files(const std::filesystem::path& bundle,
                                               const std::set<std::filesystem::path>& present);

}  // namespace vitrail
