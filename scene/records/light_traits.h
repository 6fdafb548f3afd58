// SPDX-License-Identifier: Apache-2.0
// These traits follow from the kind of a light alone, and are said once. Every kind has its row in
// light_traits.cpp: without one, a new kind does not compile.
#pragma once

#include "scene/records/light.h"

namespace vitrail {

struct LightTraits {
  bool surrounds = false;  // shines from directions all around the scene; the others have no extent
  bool parallel = false;   // some of it comes along one direction: a distant light, the sun of a sky
  bool is_far() const { return surrounds || parallel; }  // it has no place in the scene
};
LightTraits traits_of(const LightModel& model);

}  // namespace vitrail
