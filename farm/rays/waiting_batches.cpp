// SPDX-License-Identifier: Apache-2.0
#include "farm/rays/waiting_batches.h"

#include <utility>

namespace vitrail {

void WaitingBatches::push(RayBatch batch) {
  if (held_bytes_ + batch.held_bytes() > most_bytes_) {
    disk_.push_back(file_.write(batch));
    return;
  }
  held_bytes_ += batch.held_bytes();
  memory_.push_back(std::move(batch));
}

RayBatch WaitingBatches::pop() {
  if (memory_.empty()) {
    const RayFile::Place place = disk_.back();
    disk_.pop_back();
    return file_.read(place);
  }
  RayBatch batch = std::move(memory_.back());
  memory_.pop_back();
  held_bytes_ -= batch.held_bytes();
  return batch;
}

}  // namespace vitrail
