// SPDX-License-Identifier: Apache-2.0
#include "farm/rays/parcel.h"

#include <cstdint>
#include <cstring>

#include "scene/system/diagnostics.h"

namespace vitrail {

void Parcel::add(const RayBatch& batch) {
  const std::uint64_t size = batch.bytes().size();
  const auto* raw = reinterpret_cast<const std::byte*>(&size);
  bytes_.insert(bytes_.end(), raw, raw + sizeof size);
  bytes_.insert(bytes_.end(), batch.bytes().begin(), batch.bytes().end());
}

std::vector<RayBatch> unpack(const std::vector<std::byte>& message, std::size_t domains) {
  const auto refuse = [] { throw MachineError("a message came that holds no rays"); };
  std::vector<RayBatch> batches;
  for (std::size_t at = 0; at < message.size();) {
    std::uint64_t size = 0;
    if (message.size() - at < sizeof size) refuse();
    std::memcpy(&size, message.data() + at, sizeof size);
    at += sizeof size;
    if (size > message.size() - at) refuse();
    const auto first = message.begin() + static_cast<std::ptrdiff_t>(at);
    batches.emplace_back(std::vector<std::byte>(first, first + static_cast<std::ptrdiff_t>(size)));
    if (!batches.back().is_whole(domains)) refuse();
    at += size;
  }
  return batches;
}

}  // namespace vitrail
