// SPDX-License-Identifier: Apache-2.0
// An InstanceSpill takes instances to disk and back: a file for each part of the kd-tree that is to be in
// memory at once. None stays open, so there may be more parts than files that a process may have open.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "bundle/instance.h"

namespace vitrail {

// The files are private to this object: nobody else reads them.
class InstanceSpill {
 public:
  // `cells` are those of the parts of `root`, which is divided. `buffer_bytes` are in memory for each.
  InstanceSpill(const std::filesystem::path& directory, const std::vector<Bounds3f>& cells,
                const Bounds3f& root, std::uint64_t buffer_bytes);

  // Adds it to every part whose cell it reaches into. Throws MachineError.
  void add(const InstanceRef& instance);
  // Takes no memory any more, when all have come. Throws MachineError.
  void flush();
  // Returns a part in the order in which it came. Its file is gone then. Throws MachineError.
  std::vector<InstanceRef> take(std::size_t part);

  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Part {
    Bounds3f cell;
    std::filesystem::path file;
    std::vector<InstanceRef> waiting;  // the last, behind those in the file
    std::uint64_t in_file = 0;
  };
  void write(Part& part);

  std::size_t most_waiting_;  // of a part
  std::vector<Part> parts_;
  std::uint64_t bytes_ = 0;
};

}  // namespace vitrail
