// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Exporters write both faces of a lamp, or a lamp twice. Two surfaces that shine from one place to one
// side would give twice the light of the one that is seen: they count once. A triangle is left out where
// others that shine to the same sides cover it, whatever their corners; so are equal quadrics and
// instances. All of it is reported; lamps that cover one another in part are, and stay. Glows that are
// no lamps (AreaLight::sampled) stay. It does not find lamps of different instances, and quadrics on
// meshes.
void drop_coincident_lamps(ImportedScene& imported);

}  // namespace vitrail
