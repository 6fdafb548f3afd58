// SPDX-License-Identifier: Apache-2.0
#include "partitioner/writing/object_groups.h"

#include "partitioner/least_memory.h"

namespace vitrail {

namespace {

// Marks an object and all that it needs. Returns the bytes of those that had no mark, and adds these to
// `held`.
std::uint64_t mark(std::span<const ObjectInfo> objects, std::uint32_t object, std::vector<bool>& marked,
                   std::vector<std::uint32_t>& held) {
  if (marked[object]) return 0;
  marked[object] = true;
  held.push_back(object);
  std::uint64_t bytes = objects[object].bytes;
  for (const std::uint32_t inner : objects[object].objects) bytes += mark(objects, inner, marked, held);
  return bytes;
}

}  // namespace

std::uint64_t bytes_with_inner(std::span<const ObjectInfo> objects, std::uint32_t object) {
  std::vector<bool> marked(objects.size());
  std::vector<std::uint32_t> held;
  return mark(objects, object, marked, held);
}

std::map<std::uint32_t, std::uint32_t> groups_of(std::span<const ObjectInfo> objects,
                                                 const std::map<std::uint32_t, std::uint64_t>& places,
                                                 std::uint64_t most_bytes, std::uint64_t own_bytes) {
  std::map<std::uint32_t, std::uint32_t> groups;
  std::vector<bool> in_group(objects.size());
  std::vector<std::uint32_t> held;  // by the group
  std::uint32_t group = 0;
  std::uint64_t bytes = own_bytes;
  for (const auto& [object, count] : places) {
    const std::uint64_t places_bytes = count * bytes_of_reference;
    std::uint64_t more = places_bytes + mark(objects, object, in_group, held);
    if (bytes > 0 && bytes + more > most_bytes) {
      for (const std::uint32_t o : held) in_group[o] = false;
      held.clear();
      ++group, bytes = 0;
      more = places_bytes + mark(objects, object, in_group, held);
    }
    bytes += more;
    groups[object] = group;
  }
  return groups;
}

std::vector<std::vector<InstanceRef>> groups_by_objects(std::span<const ObjectInfo> objects,
                                                        std::span<const InstanceRef> instances,
                                                        std::uint64_t most_bytes, std::uint64_t own_bytes) {
  std::map<std::uint32_t, std::uint64_t> places;
  for (const InstanceRef& ref : instances) ++places[ref.object];
  const std::map<std::uint32_t, std::uint32_t> groups = groups_of(objects, places, most_bytes, own_bytes);
  std::vector<std::vector<InstanceRef>> parted(groups.empty() ? 1 : groups.rbegin()->second + 1);
  for (const InstanceRef& ref : instances) parted[groups.at(ref.object)].push_back(ref);
  return parted;
}

}  // namespace vitrail
