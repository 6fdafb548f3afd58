// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Exporters of modellers whose faces have two materials (SketchUp, Mineways) write each face twice, back to
// back in one place. A ray meets both at once, so that chance decides which shows. This function makes them
// one surface with a material for each side (TwoSidedMaterial), which is reported.
//
// A triangle is joined where triangles of one other shape cover it that face the other way, whatever their
// corners are, as long as corners of both lie together. Both shapes are opaque and do not shine. Scenes of
// more than 2¹⁸ such triangles are left as they are, and so are quadrics and curves.
void join_faces_back_to_back(ImportedScene& imported);

}  // namespace vitrail
