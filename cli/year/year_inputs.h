// SPDX-License-Identifier: Apache-2.0
// The file inputs.json says what the films of a folder were traced for.
#pragma once

#include <vector>

#include "cli/year/year_arguments.h"
#include "scene/records/camera.h"

namespace vitrail {

// Throws Error where the folder holds a year of other suns, sensors or patches, with the files' names, unless
// --force is given; else notes these.
void require_same_inputs(const YearArguments& arguments, const std::vector<Vector3d>& suns,
                         const std::vector<Sensor>& sensors);

}  // namespace vitrail
