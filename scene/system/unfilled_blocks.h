// SPDX-License-Identifier: Apache-2.0
// Here large blocks are noted that have been taken and are not filled yet: their pages become resident later,
// when they are written to. Nothing here allocates; all of it may be called from any thread.
#pragma once

#include <cstdint>

namespace vitrail {

// `block` of `bytes` counts until it is full or removed. A removed one that does not count is ignored.
void add_unfilled_block(const void* block, std::uint64_t bytes) noexcept;
void remove_unfilled_block(const void* block) noexcept;
// Removes all.
void forget_unfilled_blocks() noexcept;

// Returns how many bytes of these blocks are not resident. The first looks at each page; the other takes what
// was found the last time, which is at least as much.
std::uint64_t unfilled_bytes() noexcept;
std::uint64_t most_unfilled_bytes() noexcept;

}  // namespace vitrail
