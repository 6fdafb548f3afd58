// SPDX-License-Identifier: Apache-2.0
// This file reads the rows of a plain JPEG file of 8 bits (ITU-T T.81), by libjpeg-turbo.
#pragma once

#include <filesystem>
#include <optional>

#include "images/byte_rows.h"

namespace vitrail {

// Returns nothing where it is no such file (byte_rows.h): it takes grey and RGB alone, from one image in the
// file.
std::optional<ByteRows> jpeg_rows(const std::filesystem::path& file);

}  // namespace vitrail
