// SPDX-License-Identifier: Apache-2.0
// Untouched memory is zero and takes none until it is touched: the system's pages, as calloc
// gives them, or those of files.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "film/film_scratch.h"

namespace vitrail {

// It makes elements without writing to them, so it is only for vectors that are made in their size and do not
// grow. Memory that is freed and given out again within a vector's capacity is not zero.
template <class T>
struct UntouchedAllocator {
  using value_type = T;
  using propagate_on_container_copy_assignment = std::true_type;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;
  std::shared_ptr<FilmScratch> scratch;  // null: in memory
  UntouchedAllocator() = default;
  UntouchedAllocator(std::shared_ptr<FilmScratch> the_scratch) : scratch(std::move(the_scratch)) {}
  template <class U>
  UntouchedAllocator(const UntouchedAllocator<U>& other) : scratch(other.scratch) {}
  T* allocate(std::size_t n) {
    if (scratch) return static_cast<T*>(scratch->allocate(n * sizeof(T)));
    void* memory = std::calloc(n, sizeof(T));
    if (!memory) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) {
    if (scratch)
      scratch->deallocate(memory, n * sizeof(T));
    else
      std::free(memory);
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    if constexpr (sizeof...(Args) > 0) ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
  bool operator==(const UntouchedAllocator&) const = default;
};

// T is a type whose value is zero bytes.
template <class T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

}  // namespace vitrail
