// SPDX-License-Identifier: Apache-2.0
// These functions say what pbrt makes of the channels of an image.
#pragma once

#include "importers/pbrt/read/version.h"
#include "scene/records/texture.h"

namespace vitrail::pbrt {

// Returns the number that a float texture takes from each pixel. v4 looks up the first channel alone where it
// takes texels by themselves, and has alpha of files that are RGBA from the outset (no palette, no other
// format than PNG and EXR). v3 knows no alpha, and decodes the luminance of what is stored.
ImageNumber number_taken(Version version, const std::string& filename, TextureFilter filter);

// Returns whether v4 asks for the encoding of the file. It does for PNG alone: other integers are sRGB, and
// floats linear.
bool takes_encoding(const std::string& filename);

// Returns the primaries that count: v4 looks at the chromaticities that it knows, for colours; v3 at none.
Primaries primaries_taken(Version version, bool is_float = false);

}  // namespace vitrail::pbrt
