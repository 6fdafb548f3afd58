// SPDX-License-Identifier: Apache-2.0
// Groups part instances that need more objects than fit into memory at once.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

// Returns the bytes of the files of an object and of all that it needs.
std::uint64_t bytes_with_inner(std::span<const ObjectInfo> objects, std::uint32_t object);

// Numbers the groups of objects that are placed so many times: by object. Each group takes at most
// `most_bytes` with the places and the files of all that it needs, the first beside `own_bytes` of
// something else. But one object with what it needs is never parted. The first group may have
// none, the others have some.
std::map<std::uint32_t, std::uint32_t> groups_of(std::span<const ObjectInfo> objects,
                                                 const std::map<std::uint32_t, std::uint64_t>& places,
                                                 std::uint64_t most_bytes, std::uint64_t own_bytes);

// Does the same for instances: within a group they keep their order.
std::vector<std::vector<InstanceRef>> groups_by_objects(std::span<const ObjectInfo> objects,
                                                        std::span<const InstanceRef> instances,
                                                        std::uint64_t most_bytes, std::uint64_t own_bytes);

}  // namespace vitrail
