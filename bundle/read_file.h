// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vitrail {

// Reads a whole file, which is noted as an input. Throws MachineError, and Error where it is no regular file.
std::vector<std::byte> read_file(const std::filesystem::path& file);

}  // namespace vitrail
