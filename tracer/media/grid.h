// SPDX-License-Identifier: Apache-2.0
// Looking up a scene/medium.h Grid.
#pragma once

#include "scene/medium.h"

namespace vitrail {

// Trilinear between the centres of the cells; p in the medium's space. `channel` < grid.channels.
double look_up(const Grid& grid, Point3d p, int channel);

double greatest_value(const Grid& grid);

}  // namespace vitrail
