// SPDX-License-Identifier: Apache-2.0
// A parcel holds batches for one rank as one message: each batch's bytes, as 8 bytes, and then the batch.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "farm/rays/batch.h"

namespace vitrail {

class Parcel {
 public:
  static constexpr std::size_t full_bytes = 1 << 20;

  void add(const RayBatch& batch);
  bool full() const { return bytes_.size() >= full_bytes; }
  bool empty() const { return bytes_.empty(); }
  std::vector<std::byte> take() { return std::exchange(bytes_, {}); }

 private:
  std::vector<std::byte> bytes_;
};

// Returns the batches of a message that came. Throws MachineError where it is no parcel of batches for one of
// `domains`.
std::vector<RayBatch> unpack(const std::vector<std::byte>& message, std::size_t domains);

}  // namespace vitrail
