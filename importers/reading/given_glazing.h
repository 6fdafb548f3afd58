// SPDX-License-Identifier: Apache-2.0
// The user may give glazing to materials of a scene, whatever the format of the scene.
#pragma once

#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// Gives each material of the name before "=" the panes of the file behind it: "Window=electro.json". Its
// surfaces stand for the whole unit without holes, and their front is outside. Throws UsageError where no
// material has the name, or where it is a part of another, and Error where the file is wrong.
void give_glazing(ImportedScene& imported, const std::vector<std::string>& given);

}  // namespace vitrail
