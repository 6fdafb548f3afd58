// SPDX-License-Identifier: Apache-2.0
// Instances within prototypes, for what knows none.
#pragma once

#include <cstdint>

#include "scene/records/scene.h"

namespace vitrail {

bool has_nested_instances(const Scene& scene);

// More shapes and instances than this are not made of fewer: they would take gigabytes.
inline constexpr std::uint64_t most_unnested_records = 1 << 24;

// The same scene, where prototypes hold shapes alone: small ones have those of their instances as shapes of
// their own, and an instance of a large one becomes one of its shapes and others of what its instances are
// of. What counts as small is chosen so that there are few records: of n levels of two instances each about
// 2^(n/2), not 2ⁿ. Throws Error where there would be too many all the same.
Scene without_nested_instances(const Scene& scene);

}  // namespace vitrail
