// SPDX-License-Identifier: Apache-2.0
// A promise about peak resident memory, kept where memory is taken: the `new` of a program that guards its
// memory looks at what is resident, and one that would break the promise throws instead.
#pragma once

#include <cstdint>
#include <new>

namespace vitrail {

// What `new` throws then.
struct MemoryRefused : std::bad_alloc {
  const char* what() const noexcept override { return "the memory that is allowed is too little"; }
};

// From now on no more than that is to be resident. Called once, while there is one thread.
void guard_memory(std::uint64_t budget_bytes);

// Asks for memory that is taken by another way than `new`. Throws MemoryRefused. The other says whether it
// would.
void ask_memory(std::uint64_t bytes);
bool memory_allows(std::uint64_t bytes);

// What was resident and what was asked for when something was refused first. Whatever exception that ends
// as, memory is the reason. Little is granted all the same from then on, so that the program can end in
// order.
struct MemoryRefusal {
  bool refused = false;
  std::uint64_t resident_bytes = 0, asked_bytes = 0;
};
MemoryRefusal memory_refusal();

}  // namespace vitrail
