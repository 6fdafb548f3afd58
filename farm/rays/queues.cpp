// SPDX-License-Identifier: Apache-2.0
#include "farm/rays/queues.h"

#include <algorithm>

namespace vitrail {

RayQueues::RayQueues(std::size_t domains, std::uint64_t most_bytes, std::optional<std::uint64_t> shuffle_seed)
    : queues_(domains), spill_(domains, most_bytes), file_(std::make_unique<RayFile>()) {
  if (shuffle_seed) shuffle_.emplace(*shuffle_seed);
}

// The last batches are the open ones, one a kind, in any order: paths, shadow rays, and photons or what is
// asked of them.
constexpr std::size_t open_batches = 3;

RayBatch& RayQueues::open_batch(std::uint32_t domain, RayKind kind) {
  std::vector<RayBatch>& queue = queues_[domain].memory;
  for (std::size_t back = 1; back <= open_batches && back <= queue.size(); ++back) {
    RayBatch& batch = queue[queue.size() - back];
    if (batch.kind() == kind && !batch.full()) return batch;
  }
  RayBatch& batch = queue.emplace_back(domain, kind);
  spill_.added(domain, batch.held_bytes());
  return batch;
}

void RayQueues::push(RayBatch batch) {
  const std::uint32_t domain = batch.domain();
  spill_.added(domain, batch.held_bytes());
  queues_[domain].memory.push_back(std::move(batch));
  make_room();
}

// A batch at a time; those that still grow last.
void RayQueues::make_room() {
  while (const auto domain = spill_.next()) {
    Queue& queue = queues_[*domain];
    const auto open = static_cast<std::ptrdiff_t>(std::min(open_batches, queue.memory.size() - 1));
    const auto batch = queue.memory.end() - 1 - open;
    queue.disk.push_back(file_->write(*batch));
    spill_.removed(*domain, batch->held_bytes());
    queue.memory.erase(batch);
  }
}

void RayQueues::shuffle(RayBatch& batch) {
  switch (batch.kind()) {
    case RayKind::path:
      std::ranges::shuffle(batch.records<RayRecord>(), *shuffle_);
      break;
    case RayKind::shadow:
      std::ranges::shuffle(batch.records<ShadowRecord>(), *shuffle_);
      break;
    case RayKind::landed:
      std::ranges::shuffle(batch.records<Photon>(), *shuffle_);
      break;
    case RayKind::question:
      std::ranges::shuffle(batch.records<Gather>(), *shuffle_);
      break;
    case RayKind::item:
      break;
  }
}

RayBatch RayQueues::pop(std::uint32_t domain) {
  Queue& queue = queues_[domain];
  RayBatch batch;
  if (queue.memory.empty()) {
    batch = file_->read(queue.disk.back());
    queue.disk.pop_back();
  } else {
    if (shuffle_) std::swap(queue.memory[(*shuffle_)() % queue.memory.size()], queue.memory.back());
    batch = std::move(queue.memory.back());
    queue.memory.pop_back();
    spill_.removed(domain, batch.held_bytes());
  }
  if (shuffle_) shuffle(batch);
  return batch;
}

}  // namespace vitrail
