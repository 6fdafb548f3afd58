// SPDX-License-Identifier: Apache-2.0
// A RayFile keeps batches of rays on the disk, of this process alone: the file has no name, so it goes with
// the process however that ends.
#pragma once

#include "farm/rays/batch.h"
#include "farm/rays/file_room.h"

namespace vitrail {

class RayFile {
 public:
  // It says where a batch lies.
  struct Place {
    std::uint32_t unit = 0, bytes = 0;  // the first of FileRoom's units
  };

  RayFile() = default;
  ~RayFile();
  RayFile(const RayFile&) = delete;
  RayFile& operator=(const RayFile&) = delete;

  // They throw MachineError where the disk is full or does not answer. The file is made with the first batch.
  Place write(const RayBatch& batch);
  RayBatch read(Place place);  // its room is used again
  std::uint64_t written_bytes() const { return written_; }

 private:
  void open();

  int descriptor_ = -1;
  FileRoom room_;
  std::uint64_t written_ = 0;
};

}  // namespace vitrail
