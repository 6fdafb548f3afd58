// SPDX-License-Identifier: Apache-2.0
// Wide sums are of 128 bits, in two's complement, and many threads add to them at once. Addition
// modulo 2¹²⁸ is exact in any order.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>

namespace vitrail {

__extension__ using Int128 = __int128;

struct WideSum {
  std::uint64_t low = 0, high = 0;
  bool operator==(const WideSum&) const = default;
};

inline Int128 value_of(const WideSum& sum) {
  return static_cast<Int128>(static_cast<unsigned __int128>(sum.high) << 64 | sum.low);
}

inline WideSum wide_sum(Int128 value) {
  return {static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64)};
}

inline WideSum& operator+=(WideSum& a, const WideSum& b) {
  a.high += b.high + (__builtin_add_overflow(a.low, b.low, &a.low) ? 1 : 0);
  return a;
}

// Adds without a lock: the one thread whose addition wraps the lower half carries into the upper one. The two
// halves belong together again once all threads are done.
inline void add_shared(WideSum& sum, const WideSum& addend) {
  std::uint64_t high = addend.high;
  if (addend.low != 0) {
    const std::uint64_t before = std::atomic_ref(sum.low).fetch_add(addend.low, std::memory_order_relaxed);
    if (before + addend.low < before) ++high;
  }
  if (high != 0) std::atomic_ref(sum.high).fetch_add(high, std::memory_order_relaxed);
}

// `whole` is a whole number below 2¹²⁷ in size.
inline WideSum wide_sum_of(double whole) {
  if (std::abs(whole) < 0x1p62) return wide_sum(static_cast<std::int64_t>(whole));
  return wide_sum(static_cast<Int128>(whole));
}

}  // namespace vitrail
