// SPDX-License-Identifier: Apache-2.0
// This function puts a layer of a picture in the place of its colours.
#pragma once

#include <string>

#include "film/develop.h"

namespace vitrail {

// `name` is as in --aov ("albedo", "normal"); layers of one value become grey, of two red and green. If
// `shown`, values are made for screens. Components of normals from −1 to 1 become 0 to 1, encoded, lengths
// are relative to the greatest, and each id has a colour of its own. Else the numbers stay as they are. The
// picture keeps nothing else. Throws Error with the layers that there are where this is none of them.
void show_layer(Picture& picture, const std::string& name, bool shown);

}  // namespace vitrail
