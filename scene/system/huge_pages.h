// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vitrail {

// Asks for huge pages under an array that is about to be filled: a large array then costs a fraction of the
// page faults.
template <class T>
void prefer_huge_pages(T* data, std::size_t count) {
  constexpr std::uintptr_t huge = std::uintptr_t{2} << 20;
  const auto begin = (reinterpret_cast<std::uintptr_t>(data) + huge - 1) / huge * huge;
  const auto end = reinterpret_cast<std::uintptr_t>(data + count) / huge * huge;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the address of a page
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

// Reserves room for `count` values in an empty vector and asks for huge pages under it.
template <class T>
void reserve_huge(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  prefer_huge_pages(values.data(), count);
}

}  // namespace vitrail
