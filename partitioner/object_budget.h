// SPDX-License-Identifier: Apache-2.0
// How many domains it takes until each fits into a budget together with the objects that its instances need.
#pragma once

#include <cstdint>
#include <vector>

#include "partitioner/writing/write_objects.h"

namespace vitrail {

// `domains` or more, tried on a sample; at most so many as a renderer can number. `instances`: of the scene.
// Throws UsageError where no number is enough.
std::uint32_t domains_within(const World& world, const SceneInstances& instances, std::uint64_t domain_bytes,
                             std::uint32_t domains);

}  // namespace vitrail
