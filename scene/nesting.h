// SPDX-License-Identifier: Apache-2.0
// Instances within prototypes, for what knows none.
#pragma once

#include "scene/scene.h"

namespace vitrail {

bool has_nested_instances(const Scene& scene);

// The same scene, where prototypes have the shapes of their instances as shapes of their own.
Scene without_nested_instances(const Scene& scene);

}  // namespace vitrail
