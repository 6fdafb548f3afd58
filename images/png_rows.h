// SPDX-License-Identifier: Apache-2.0
// This file reads the rows of a plain PNG file of 8 bits (ISO/IEC 15948).
#pragma once

#include <filesystem>
#include <optional>

#include "images/byte_rows.h"

namespace vitrail {

// Returns nothing where it is no such file (byte_rows.h).
std::optional<ByteRows> png_rows(const std::filesystem::path& file);

}  // namespace vitrail
