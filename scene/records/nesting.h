// SPDX-License-Identifier: Apache-2.0
// These functions replace instances within prototypes, for programs that know none.
#pragma once

#include <cstdint>

#include "scene/records/scene.h"

namespace vitrail {

bool has_nested_instances(const Scene& scene);

// More shapes and instances than this are not made of fewer: they would take gigabytes.
inline constexpr std::uint64_t most_unnested_records = 1 << 24;

// Returns the same scene, where prototypes hold shapes alone. Small ones have those of their instances as
// shapes of their own. An instance of a large one becomes one of its shapes and others of what its instances
// are of. The bound for small ones is chosen so that there are few records: of n levels of two instances each
// about 2^(n/2), not 2ⁿ. Throws Error where there would be too many all the same.
Scene without_nested_instances(const Scene& scene);

}  // namespace vitrail
