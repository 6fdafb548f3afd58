// SPDX-License-Identifier: Apache-2.0
#include "farm/queues.h"

#include <algorithm>

namespace vitrail {

RayQueues::RayQueues(std::size_t domains, std::optional<std::uint64_t> shuffle_seed) : queues_(domains) {
  if (shuffle_seed) shuffle_.emplace(*shuffle_seed);
}

void RayQueues::push(RayBatch batch) {
  const std::uint32_t domain = batch.domain();
  queues_[domain].push_back(std::move(batch));
}

RayBatch RayQueues::pop(std::uint32_t domain) {
  std::vector<RayBatch>& queue = queues_[domain];
  if (shuffle_) std::swap(queue[(*shuffle_)() % queue.size()], queue.back());
  RayBatch batch = std::move(queue.back());
  queue.pop_back();
  if (shuffle_) {
    if (batch.kind() == RayKind::path)
      std::ranges::shuffle(batch.records<PathRecord>(), *shuffle_);
    else
      std::ranges::shuffle(batch.records<ShadowRecord>(), *shuffle_);
  }
  return batch;
}

}  // namespace vitrail
