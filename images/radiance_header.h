// SPDX-License-Identifier: Apache-2.0
// The header of a Radiance picture (.hdr) says how its pixels are stored. OpenImageIO returns them as they
// are stored.
#pragma once

#include <string_view>
#include <vector>

namespace vitrail {

struct RadianceHeader {
  float exposure = 1;  // the pixels were multiplied by it
  // Rows of the file are columns; they go from right to left, or from the bottom up.
  bool is_transposed = false, from_right = false, from_below = false;
  bool is_turned() const { return is_transposed || from_right || from_below; }
};

// Reads the header at the beginning of a file, `bytes`. Missing lines have the usual values: exposure 1, "-Y
// height +X width".
RadianceHeader radiance_header(std::string_view bytes);

// Puts the pixels of a file of `width` × `height` into rows from the top, each from the left, and takes the
// exposure away. Where the header transposes, width and height change places.
void undo(const RadianceHeader& header, std::vector<float>& values, int& width, int& height, int channels);

}  // namespace vitrail
