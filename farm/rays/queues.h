// SPDX-License-Identifier: Apache-2.0
// The rays that wait on this rank stand here, a queue a domain; the scheduler counts them. Those beyond what
// memory has room for wait on the disk (scheduler/spill.h). It is not synchronised: the rank's mutex guards
// it.
#pragma once

#include <memory>
#include <optional>
#include <random>

#include "farm/rays/batch.h"
#include "farm/rays/ray_file.h"
#include "farm/scheduler/spill.h"

namespace vitrail {

class RayQueues {
 public:
  // Keeps at most `most_bytes` in memory. With a `shuffle_seed`, batches and the rays in them leave in an
  // arbitrary order: no picture may depend on it.
  RayQueues(std::size_t domains, std::uint64_t most_bytes, std::optional<std::uint64_t> shuffle_seed);

  // Both throw MachineError where the disk cannot take what is too much.
  template <class Record>
  void push(std::uint32_t domain, const Record& record) {
    RayBatch& batch = open_batch(domain, kind_of<Record>());
    const std::size_t before = batch.held_bytes();
    batch.append(record);
    spill_.added(domain, batch.held_bytes() - before);
    make_room();
  }
  void push(RayBatch batch);
  // Returns the newest batch of a domain in memory, else one from the disk; there is one.
  RayBatch pop(std::uint32_t domain);

  bool empty(std::uint32_t domain) const {
    return queues_[domain].memory.empty() && queues_[domain].disk.empty();
  }
  std::uint64_t held_bytes() const { return spill_.held_bytes(); }        // in memory
  std::uint64_t written_bytes() const { return file_->written_bytes(); }  // to the disk, in all

 private:
  struct Queue {
    std::vector<RayBatch> memory;
    std::vector<RayFile::Place> disk;
  };

  RayBatch& open_batch(std::uint32_t domain, RayKind kind);
  void make_room();
  void shuffle(RayBatch& batch);

  std::vector<Queue> queues_;
  Spill spill_;
  std::unique_ptr<RayFile> file_;
  std::optional<std::mt19937_64> shuffle_;
};

}  // namespace vitrail
