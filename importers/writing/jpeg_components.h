// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vitrail {

// Returns the number of components of a JPEG file, by its frame header (T.81, B.2.2): 4 are inks, which few
// programs read. It is 0 where the file has no such header. Throws Error where the file cannot be opened.
int jpeg_components(const std::string& filename);

}  // namespace vitrail
