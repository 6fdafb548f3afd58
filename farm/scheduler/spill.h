// SPDX-License-Identifier: Apache-2.0
// Spill decides which waiting rays leave memory for the disk. Nothing else gives way: a rank takes whatever
// arrives and never waits for room, so that no ring of full ranks can wait for each other.
#pragma once

#include "farm/scheduler/fullest.h"

namespace vitrail {

// It counts the bytes of rays that wait in memory, by domain.
class Spill {
 public:
  Spill(std::size_t domains, std::uint64_t most_bytes);

  void added(std::uint32_t domain, std::uint64_t bytes);
  void removed(std::uint32_t domain, std::uint64_t bytes);
  // Returns whose rays are to be written next: those of the domain that has most in memory, so that few and
  // large pieces are written. It returns nothing where the bytes held are within bounds.
  std::optional<std::uint32_t> next() const;
  std::uint64_t held_bytes() const { return held_; }

 private:
  void set(std::uint32_t domain, std::uint64_t bytes);

  std::uint64_t most_, held_ = 0;
  std::vector<std::uint64_t> bytes_;  // by domain
  Fullest fullest_;                   // domains with rays in memory
};

}  // namespace vitrail
