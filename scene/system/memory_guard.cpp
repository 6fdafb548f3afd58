// SPDX-License-Identifier: Apache-2.0
#include "scene/system/memory_guard.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <utility>

#include "scene/system/resource_usage.h"
#include "scene/system/unfilled_blocks.h"

namespace vitrail {

namespace {

// A thread looks at what is resident each time that it has taken so much, in whatever pieces ...
constexpr std::uint64_t portion = 256 << 10;
// ... and before it takes one as large as this.
constexpr std::uint64_t large = 1 << 20;

std::atomic<std::uint64_t> limit{~std::uint64_t{0}};  // of what is resident
std::uint64_t reserve = 0;                            // of the budget, beyond the limit
std::atomic<bool> guarding{false};
std::atomic<bool (*)()> is_own_thread{nullptr};
std::atomic<std::uint64_t> promised{0};  // to all threads that asked, and not taken yet
std::atomic<bool> refused{false};
std::atomic<std::uint64_t> resident_then{0}, asked_then{0};

std::atomic<int> attempt{0};  // at the work: promises of an earlier one are void

// Of this thread.
thread_local int own_attempt = 0;
thread_local std::uint64_t taken = 0;        // since it looked
thread_local std::uint64_t own_promise = 0;  // of what it asked for, until its next large block
thread_local std::uint64_t promised_at = 0;  // resident then
thread_local int granted = 0;                // lives of GrantedMemory
thread_local bool is_guarded = false;        // it called guard_memory

// What becomes resident is no longer promised.
void fulfil(std::uint64_t resident) {
  if (own_attempt != attempt) own_attempt = attempt, own_promise = 0;
  const std::uint64_t filled = std::min(own_promise, resident - std::min(resident, promised_at));
  promised -= filled;
  own_promise -= filled;
  promised_at = std::max(promised_at, resident);
}

bool allows(std::uint64_t bytes) {
  fulfil(resident_bytes());
  // What is filled meanwhile may count twice, but is not left out.
  const auto allow = [bytes](std::uint64_t unfilled) {
    return unfilled + promised + bytes + resident_bytes() <= limit;
  };
  if (allow(most_unfilled_bytes()) || allow(unfilled_bytes())) return true;
  ::malloc_trim(0);  // freed blocks that malloc keeps
  return allow(unfilled_bytes());
}

// An exception may pass: not while another one does, and not through a thread that is not ours.
bool can_refuse() {
  if (std::uncaught_exceptions() > 0) return false;
  const auto is_own = is_own_thread.load(std::memory_order_relaxed);
  return is_guarded || !is_own || is_own();
}

void require(std::uint64_t bytes) {
  if (allows(bytes) || !can_refuse()) return;
  if (!refused.exchange(true))
    resident_then = resident_bytes() + promised + unfilled_bytes(), asked_then = bytes;
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
  if (granted > 0) return fulfil(resident_bytes());
  if (bytes < large) return require(0);
  fulfil(resident_bytes());
  promised -= std::exchange(own_promise, 0);
  require(bytes);
}

bool is_guarding() { return guarding.load(std::memory_order_relaxed); }

void* block_or_null(std::size_t bytes, std::size_t alignment) {
  return alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
             ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
             : std::malloc(std::max<std::size_t>(bytes, 1));
}

// A library's are part of what was asked for it.
void watch(void* block, std::size_t bytes) {
  if (bytes >= large && is_guarding() && granted == 0) add_unfilled_block(block, bytes);
}

void* block_of(std::size_t bytes, std::size_t alignment) {
  if (is_guarding()) take(bytes);
  void* const block = block_or_null(bytes, alignment);
  if (!block) throw std::bad_alloc();
  watch(block, bytes);
  return block;
}

// Its caller does without, as std::stable_sort: nothing is refused.
void* block_if_allowed(std::size_t bytes, std::size_t alignment) {
  if (bytes >= large && granted == 0 && !memory_allows(bytes)) return nullptr;
  if (bytes < large && is_guarding()) taken += bytes;
  void* const block = block_or_null(bytes, alignment);
  if (block) watch(block, bytes);
  return block;
}

void free_block(void* block) noexcept {
  if (is_guarding() && ::malloc_usable_size(block) >= large) remove_unfilled_block(block);
  std::free(block);
}

}  // namespace

MemoryNeeded::MemoryNeeded(std::uint64_t budget_bytes, std::uint64_t needed_bytes,
                           const std::string& what_for)
    : MachineError(fmt::format("{} MiB of memory are too little for {}; try --memory {}M", budget_bytes >> 20,
                               what_for, (needed_bytes + (1 << 20) - 1) >> 20)) {}

void guard_memory(std::uint64_t budget_bytes, bool (*is_own)()) {
  reserve = std::min(memory_reserve(budget_bytes), budget_bytes);
  limit = budget_bytes - reserve;
  forget_refusal();
  is_own_thread = is_own;
  is_guarded = true;
  guarding = true;
}

// Blocks that are freed from now on are not noted.
void guard_no_more() {
  guarding = false;
  forget_unfilled_blocks();
}

GrantedMemory::GrantedMemory(std::uint64_t bytes) : bytes_(bytes) {
  if (bytes_ > 0) ask_memory(bytes_);
  ++granted;
}

GrantedMemory::~GrantedMemory() {
  --granted;
  fulfil(resident_bytes());
  const std::uint64_t unused = std::min(own_promise, bytes_);
  promised -= unused;
  own_promise -= unused;
  if (granted == 0 && bytes_ > 0) taken = portion;  // the next block looks at what is resident
}

GuardedMemory::GuardedMemory() : granted_(std::exchange(granted, 0)) {}
GuardedMemory::~GuardedMemory() { granted = granted_; }

void ask_memory(std::uint64_t bytes) {
  if (is_guarding()) promise(bytes);
}

bool memory_allows(std::uint64_t bytes) { return !is_guarding() || allows(bytes); }

MemoryRefusal memory_refusal() { return {refused, resident_then, asked_then}; }

void forget_refusal() {
  ++attempt;
  promised = 0;
  refused = false;
}

LentReserve::LentReserve() : before_(memory_refusal()), bytes_(is_guarding() ? reserve / 4 * 3 : 0) {
  if (is_guarding()) forget_code_pages();
  constexpr std::uint64_t least = 2 << 20, least_budget = 15 << 20;
  if (const std::uint64_t enough =
          std::min(resident_bytes() + least, std::max(limit + reserve, least_budget));
      is_guarding() && enough > limit)
    bytes_ = std::max(bytes_, enough - limit);
  forget_refusal();
  limit += bytes_;
}

LentReserve::~LentReserve() {
  limit -= bytes_;
  resident_then = before_.resident_bytes, asked_then = before_.asked_bytes;
  refused = before_.refused;
}

// A huge page is between two looks, too.
std::uint64_t memory_reserve(std::uint64_t budget_bytes) {
  return std::clamp<std::uint64_t>(budget_bytes / 64, 3 << 20, 16 << 20);
}

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
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return vitrail::block_if_allowed(bytes, 1);
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return vitrail::block_if_allowed(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { vitrail::free_block(block); }
void operator delete(void* block, std::size_t) noexcept { vitrail::free_block(block); }
void operator delete(void* block, std::align_val_t) noexcept { vitrail::free_block(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { vitrail::free_block(block); }

#endif
