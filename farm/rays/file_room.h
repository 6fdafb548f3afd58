// SPDX-License-Identifier: Apache-2.0
// A FileRoom knows which parts of a file are in use, in units of 1 KiB, by slabs of 64 of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace vitrail {

class FileRoom {
 public:
  static constexpr std::uint32_t unit_bytes = 1 << 10, slab_units = 64;

  // Takes units that are neighbours in one slab, 1 to 64 of them. They are the first that were given back,
  // else they lie behind all others. Returns the number of the first.
  std::uint32_t take(std::uint32_t units);
  void give_back(std::uint32_t first, std::uint32_t units);

 private:
  std::vector<std::uint64_t> free_;  // a slab each, a bit for each unit
  // It has an entry for each number of units: no slab before from_[n] has n that are free and neighbours.
  std::array<std::uint32_t, slab_units + 1> from_{};
};

}  // namespace vitrail
