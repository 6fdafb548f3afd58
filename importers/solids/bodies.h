// SPDX-License-Identifier: Apache-2.0
// These functions split a solid into the bodies that it is made of.
#pragma once

#include <vector>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// Returns parts that hang together, each a solid, if their boxes overlap and each encloses a volume of its
// own: such parts may intersect. Else it returns the solid as it is: parts may be holes of others.
std::vector<Solid> bodies_of(const Solid& solid);

// Puts bodies whose boxes do not touch into one solid: an operation on it is as good as one on each.
std::vector<Solid> grouped(const std::vector<Solid>& bodies);

}  // namespace vitrail::solids
