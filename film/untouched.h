// SPDX-License-Identifier: Apache-2.0
// Memory that is zero and takes none until it is touched, as calloc gives it of the system's pages.
#pragma once

#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace vitrail {

// Makes elements without writing to them, so only for vectors that are made in their size and do not grow:
// what is freed and given out again within a vector's capacity is not zero.
template <class T>
struct UntouchedAllocator {
  using value_type = T;
  UntouchedAllocator() = default;
  template <class U>
  UntouchedAllocator(const UntouchedAllocator<U>&) {}
  T* allocate(std::size_t n) {
    void* memory = std::calloc(n, sizeof(T));
    if (!memory) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    if constexpr (sizeof...(Args) > 0) ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
  bool operator==(const UntouchedAllocator&) const = default;
};

// Of a T whose value is zero bytes.
template <class T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

}  // namespace vitrail
