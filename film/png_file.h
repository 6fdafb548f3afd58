// SPDX-License-Identifier: Apache-2.0
// This file writes .png by a library of its own, which needs little: `render` writes them itself.
#pragma once

#include <filesystem>
#include <string>

#include "film/develop.h"

namespace vitrail {

// Writes the colours as write_picture (image_io.h) has them, of 8 or 16 `bits`,
// with alpha where there is one; colours are then straight (alpha.h). Also
// writes the place of the picture in its whole, the date, and a comment where
// it was denoised. The file appears whole or not at all. Throws MachineError.
void write_png(const std::filesystem::path& file, const Picture& picture, int bits = 8);

// Returns what files that hold integers say of the picture; empty means nothing.
std::string comment_on(const PictureOrigin& origin);

}  // namespace vitrail
