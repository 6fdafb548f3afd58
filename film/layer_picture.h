// SPDX-License-Identifier: Apache-2.0
// A layer of a picture in the place of its colours.
#pragma once

#include <string>

#include "film/develop.h"

namespace vitrail {

// `name`: as --aov has it ("albedo", "normal"); layers of one value become grey, of two red and green.
// `shown`: for screens: components of normals from −1 to 1 become 0 to 1, encoded, lengths are relative to
// the greatest, and each id has a colour of its own; else the numbers as they are. The picture keeps nothing
// else. Throws Error with what layers there are where this is none of them.
void show_layer(Picture& picture, const std::string& name, bool shown);

}  // namespace vitrail
