// SPDX-License-Identifier: Apache-2.0
// They hold batches that wait for a worker, whatever their domain: questions of paths to the photons of this
// rank. Those beyond what memory has room for wait on the disk. It is not synchronised: the rank's mutex
// guards it.
#pragma once

#include <vector>

#include "farm/rays/batch.h"
#include "farm/rays/ray_file.h"

namespace vitrail {

class WaitingBatches {
 public:
  explicit WaitingBatches(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  // Both throw MachineError where the disk cannot take what is too much, or lost it.
  void push(RayBatch batch);
  // Returns the newest in memory, else one from the disk; there is one.
  RayBatch pop();

  bool empty() const { return memory_.empty() && disk_.empty(); }
  std::uint64_t held_bytes() const { return held_bytes_; }               // in memory
  std::uint64_t written_bytes() const { return file_.written_bytes(); }  // to the disk, in all

 private:
  std::vector<RayBatch> memory_;
  std::vector<RayFile::Place> disk_;
  RayFile file_;
  std::uint64_t most_bytes_, held_bytes_ = 0;
};

}  // namespace vitrail
