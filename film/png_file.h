// SPDX-License-Identifier: Apache-2.0
// Pictures as .png. A library of its own, which needs little: `render` writes them itself.
#pragma once

#include <filesystem>
#include <string>

#include "film/develop.h"

namespace vitrail {

// The colours as write_picture (image_io.h) has them, of 8 or 16 `bits`, with the place of the picture in its
// whole, the date, and a comment where it was denoised; with alpha where there is one, whose colours are
// straight (alpha.h). The file appears whole or not at all. Throws
// MachineError.
void write_png(const std::filesystem::path& file, const Picture& picture, int bits = 8);

// What files that hold integers say of the picture; empty: nothing.
std::string comment_on(const PictureOrigin& origin);

}  // namespace vitrail
