// SPDX-License-Identifier: Apache-2.0
#include "farm/rays/file_room.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace vitrail {

namespace {

// The bits at which so many set ones begin.
std::uint64_t runs_of(std::uint64_t bits, std::uint32_t length) {
  for (std::uint32_t have = 1; have < length;) {
    const std::uint32_t more = std::min(have, length - have);
    bits &= bits >> more;
    have += more;
  }
  return bits;
}

std::uint64_t mask_of(std::uint32_t first, std::uint32_t units) {
  return ~std::uint64_t{0} >> (FileRoom::slab_units - units) << first;
}

}  // namespace

std::uint32_t FileRoom::take(std::uint32_t units) {
  if (units < 1 || units > slab_units) throw std::logic_error("no slab of a file has so many units");
  std::uint32_t& slab = from_[units];
  while (slab < free_.size() && runs_of(free_[slab], units) == 0) ++slab;
  if (slab == free_.size()) free_.push_back(~std::uint64_t{0});
  const auto first = static_cast<std::uint32_t>(std::countr_zero(runs_of(free_[slab], units)));
  free_[slab] &= ~mask_of(first, units);
  return slab * slab_units + first;
}

void FileRoom::give_back(std::uint32_t first, std::uint32_t units) {
  const std::uint32_t slab = first / slab_units;
  free_.at(slab) |= mask_of(first % slab_units, units);
  for (std::uint32_t n = 1; n <= slab_units && runs_of(free_[slab], n) != 0; ++n)
    from_[n] = std::min(from_[n], slab);
}

}  // namespace vitrail
