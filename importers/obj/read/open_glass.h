// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail::obj {

// OBJ has no word for a sheet of glass: programs write the same material for a window of one face as for a
// solid pane. A surface around nothing has no inside, so parts of glass (scene/shapes/mesh_parts.h) that are
// open or folded become sheets, thin dielectrics, and the other parts of their meshes stay solid; so do two
// faces that are a pane without its rim. A face that stands twice in one place stands once. All of it is
// reported.
void make_open_glass_thin(ImportedScene& imported);

}  // namespace vitrail::obj
