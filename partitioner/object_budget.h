// SPDX-License-Identifier: Apache-2.0
// This file finds a number of domains that fit into a budget with the objects that their instances need.
#pragma once

#include <cstdint>
#include <vector>

#include "partitioner/writing/write_objects.h"

namespace vitrail {

// Returns `domains`, or 4, 16 … times as many where that helps enough on a sample. A renderer has to be able
// to number them. `instances` are the scene's. Throws UsageError where an object alone is too large.
std::uint32_t domains_within(const World& world, const SceneInstances& instances, std::uint64_t domain_bytes,
                             std::uint32_t domains);

}  // namespace vitrail
