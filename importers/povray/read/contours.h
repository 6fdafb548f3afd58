// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::pov {

// Returns contours in a plane as polygons without holes: a hole (inside of an odd number of others) is joined
// to what is around it by a cut that is passed both ways. Contours do not cross.
std::vector<std::vector<Point3d>> joined_contours(const std::vector<std::vector<Point3d>>& contours);

}  // namespace vitrail::pov
