// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/system/huge_pages.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

// It holds plain records whose number is not known in advance. Unlike a std::vector it grows without a second
// copy in memory (a large block is moved by its page table), and can be turned into one.
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  GrowingArray() = default;
  ~GrowingArray() { std::free(data_); }
  GrowingArray(const GrowingArray& other) { append({other.data_, other.size_}); }
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): the copy is made first
  GrowingArray& operator=(const GrowingArray& other) { return *this = GrowingArray(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray gone(std::move(other));
    swap(gone);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

  void push_back(const T& value) {
    if (size_ == capacity_) grow(size_ + 1);
    data_[size_++] = value;
  }
  void append(std::span<const T> values) {
    if (values.empty()) return;
    if (size_ + values.size() > capacity_) grow(size_ + values.size());
    std::memcpy(static_cast<void*>(data_ + size_), values.data(), values.size_bytes());
    size_ += values.size();
  }

  // Calls visit(span) with all values in order, in spans of a multiple of `group` but for the last. It frees
  // the memory behind them; the array is empty then.
  template <class Visit>
  void consume(Visit&& visit, std::size_t group = 1) {
    const std::size_t piece = (std::size_t{4} << 20) / (sizeof(T) * group) * group;
    for (std::size_t i = 0; i < size_; i += piece) {
      const std::span<const T> next(data_ + i, std::min(piece, size_ - i));
      visit(next);
      release(next);
    }
    *this = {};
  }

  std::vector<T> take() {
    std::vector<T> result;
    result.reserve(size_);
    prefer_huge_pages(result.data(), size_);
    consume([&](std::span<const T> piece) { result.insert(result.end(), piece.begin(), piece.end()); });
    return result;
  }

 private:
  void swap(GrowingArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }
  void grow(std::size_t least) {
    std::size_t capacity = std::max({least, 2 * capacity_, std::size_t{16}});
    if (capacity - capacity_ >= (std::size_t{1} << 20) / sizeof(T)) {
      if (!memory_allows((capacity - capacity_) * sizeof(T)))
        capacity = std::max(least, capacity_ + capacity_ / 8);
      ask_memory((capacity - capacity_) * sizeof(T));
    }
    void* const grown = std::realloc(static_cast<void*>(data_), capacity * sizeof(T));
    if (!grown) throw std::bad_alloc();
    data_ = static_cast<T*>(grown);
    capacity_ = capacity;
  }
  // Gives back the whole pages within: they read as zero from now on.
  static void release(std::span<const T> values) {
    static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = (reinterpret_cast<std::uintptr_t>(values.data()) + page - 1) / page * page;
    const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.size()) / page * page;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the address of a page
    if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace vitrail
