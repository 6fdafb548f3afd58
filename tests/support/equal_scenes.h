// SPDX-License-Identifier: Apache-2.0
// Whether two Scenes are the same, however their records are numbered.
#pragma once

#include <string>

#include "scene/records/scene.h"

namespace vitrail::test {

// What is in use, numbered in the order of its first use by the shapes, the prototypes, the lights and the
// camera. Names and places are left out: writers have to give names where there were none.
Scene canonical(const Scene& scene);

// "" where the canonical forms of the two are equal bit for bit, else what differs first: "material 3".
std::string difference(const Scene& a, const Scene& b);

}  // namespace vitrail::test
