// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/laws/exact/ghost_free.h"

namespace vitrail::test {

// Pieces lie in their triangle, their areas add up to its own, and no part is missing: within 2⁻⁴⁶ (some
// roundings of a double) of the triangle's greatest coordinate, on every side. Clipped anew, with 11 bits
// more than the partitioner has. Where along an edge or within a plane that is nearly an interface's a vertex
// lies is free.
void check_clipping(const BundleGeometry& bundle, Problems& problems);

}  // namespace vitrail::test
