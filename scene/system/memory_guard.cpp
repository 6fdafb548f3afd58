// SPDX-License-Identifier: Apache-2.0
#include "scene/system/memory_guard.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <utility>

#include "scene/system/resource_usage.h"

namespace vitrail {

namespace {

// A thread looks at what is resident each time that it has taken so much, in whatever pieces ...
constexpr std::uint64_t portion = 256 << 10;
// ... and before it takes one as large as this.
constexpr std::uint64_t large = 1 << 20;

std::atomic<std::uint64_t> limit{~std::uint64_t{0}};  // of what is resident
std::atomic<bool> guarding{false};
std::atomic<std::uint64_t> promised{0};  // to all threads, of large blocks that are not filled yet
std::atomic<bool> refused{false};
std::atomic<std::uint64_t> resident_then{0}, asked_then{0};

// Of this thread.
thread_local std::uint64_t taken = 0;        // since it looked
thread_local std::uint64_t own_promise = 0;  // of its last large block
thread_local std::uint64_t promised_at = 0;  // resident then

// What becomes resident is no longer promised.
void fulfil(std::uint64_t resident) {
  const std::uint64_t filled = std::min(own_promise, resident - std::min(resident, promised_at));
  promised -= filled;
  own_promise -= filled;
  promised_at = std::max(promised_at, resident);
}

bool allows(std::uint64_t bytes) {
  std::uint64_t now = resident_bytes();
  fulfil(now);
  // Freed blocks that malloc keeps can be given back.
  if (now + promised + bytes > limit) {
    ::malloc_trim(0);
    now = resident_bytes();
  }
  return now + promised + bytes <= limit;
}

void require(std::uint64_t bytes) {
  if (allows(bytes)) return;
  if (!refused.exchange(true))
    resident_then = resident_bytes() + promised, asked_then = bytes;
  else if (bytes < large)
    return;
  throw MemoryRefused();
}

void promise(std::uint64_t bytes) {
  require(bytes);
  promised_at = resident_bytes();
  promised += bytes;
  own_promise += bytes;
}

void take(std::uint64_t bytes) {
  taken += bytes;
  if (taken < portion) return;
  taken = 0;
  if (bytes < large) return require(0);
  promised -= std::exchange(own_promise, 0);
  promise(bytes);
}

bool is_guarding() { return guarding.load(std::memory_order_relaxed); }

void* block_of(std::size_t bytes, std::size_t alignment) {
  if (is_guarding()) take(bytes);
  void* const block = alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
                          ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
                          : std::malloc(std::max<std::size_t>(bytes, 1));
  if (!block) throw std::bad_alloc();
  return block;
}

}  // namespace

void guard_memory(std::uint64_t budget_bytes) {
  // For what threads take between two looks, a huge page of it, and for an orderly end.
  const std::uint64_t reserve = std::clamp<std::uint64_t>(budget_bytes / 64, 3 << 20, 16 << 20);
  limit = budget_bytes - std::min(reserve, budget_bytes);
  guarding = true;
}

void ask_memory(std::uint64_t bytes) {
  if (is_guarding()) promise(bytes);
}

bool memory_allows(std::uint64_t bytes) { return !is_guarding() || allows(bytes); }

MemoryRefusal memory_refusal() { return {refused, resident_then, asked_then}; }

}  // namespace vitrail

// Sanitizers and valgrind have a `new` of their own, which they want to keep. GCC says by macros that they
// are there, clang by features.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define VITRAIL_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VITRAIL_SANITIZED
#endif

#if !defined(VITRAIL_SANITIZED)

void* operator new(std::size_t bytes) { return vitrail::block_of(bytes, 1); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return vitrail::block_of(bytes, static_cast<std::size_t>(alignment));
}

#endif
