// SPDX-License-Identifier: Apache-2.0
// The rays that wait on this rank, a queue a domain; the scheduler counts them. Not synchronised: the rank's
// mutex guards it.
#pragma once

#include <optional>
#include <random>

#include "farm/batch.h"

namespace vitrail {

class RayQueues {
 public:
  // With a `shuffle_seed`, batches and the rays in them leave in an arbitrary order: no picture may depend on
  // it.
  RayQueues(std::size_t domains, std::optional<std::uint64_t> shuffle_seed);

  template <class Record>
  void push(std::uint32_t domain, const Record& record) {
    std::vector<RayBatch>& queue = queues_[domain];
    // The last two batches are the open ones, one a kind, in either order.
    for (std::size_t back = 1; back <= 2 && back <= queue.size(); ++back) {
      RayBatch& batch = queue[queue.size() - back];
      if (batch.kind() != kind_of<Record>()) continue;
      if (batch.full()) break;
      batch.append(record);
      return;
    }
    queue.emplace_back(domain, kind_of<Record>()).append(record);
  }
  void push(RayBatch batch);
  // The newest batch of a domain; there is one.
  RayBatch pop(std::uint32_t domain);

  bool empty(std::uint32_t domain) const { return queues_[domain].empty(); }

 private:
  std::vector<std::vector<RayBatch>> queues_;
  std::optional<std::mt19937_64> shuffle_;
};

}  // namespace vitrail
