// SPDX-License-Identifier: Apache-2.0
// A program keeps its promise about peak resident memory where memory is taken. The `new` of a program that
// guards its memory looks at what is resident, and throws where the promise would be broken.
#pragma once

#include <cstdint>
#include <new>
#include <string>

#include "scene/system/diagnostics.h"

namespace vitrail {

// `new` throws it where the promise would be broken.
struct MemoryRefused : std::bad_alloc {
  const char* what() const noexcept override { return "the memory that is allowed is too little"; }
};

// A plan throws it where the budget is too little; it says which budget is enough.
struct MemoryNeeded : MachineError {
  // `what_for` completes "256 MiB of memory are too little for".
  MemoryNeeded(std::uint64_t budget_bytes, std::uint64_t needed_bytes, const std::string& what_for);
};

// No more than the budget is to be resident from now on, until `guard_no_more`, after which it
// may be called again. Meanwhile no other thread takes memory. Memory is refused to this thread, and to those
// of which `is_own` says that they run our code now: threads that libraries start for themselves are granted
// all, for nobody would catch the exception there.
void guard_memory(std::uint64_t budget_bytes, bool (*is_own)() = nullptr);
void guard_no_more();

// Within its life this thread is refused nothing. It encloses code that no exception may pass: libraries,
// their initialisers, destructors. It asks beforehand for what that code takes, and throws MemoryRefused
// where this is not there.
class GrantedMemory {
 public:
  explicit GrantedMemory(std::uint64_t bytes = 0);
  ~GrantedMemory();
  GrantedMemory(const GrantedMemory&) = delete;
  GrantedMemory& operator=(const GrantedMemory&) = delete;

 private:
  std::uint64_t bytes_;
};

// Within its life memory is refused again: it encloses code of ours that a library calls back inside
// GrantedMemory.
class GuardedMemory {
 public:
  GuardedMemory();
  ~GuardedMemory();
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;

 private:
  int granted_;
};

// ask_memory asks for memory that is taken by another way than `new`, and throws MemoryRefused. memory_allows
// returns whether the bytes would be granted.
void ask_memory(std::uint64_t bytes);
bool memory_allows(std::uint64_t bytes);

// It tells what was resident and what was asked for at the first refusal. Whatever exception the refusal ends
// as, memory is the reason. Later small requests are granted all the same, so that the program can end in
// order.
struct MemoryRefusal {
  bool refused = false;
  std::uint64_t resident_bytes = 0, asked_bytes = 0;
};
MemoryRefusal memory_refusal();
// Forgets the refusal, before the same work is tried in another way. Called while no other thread works.
void forget_refusal();
// Within its life most of the reserve (below) may be taken, too, as if nothing had been refused. At least 2
// MiB beyond what is resident may be taken where the budget has them or is below 15 MiB: the resident part of
// a program varies with the system's cache of files. After it the refusal before is the reason again. It
// serves what is done last, while no other thread works.
class LentReserve {
 public:
  LentReserve();
  ~LentReserve();
  LentReserve(const LentReserve&) = delete;
  LentReserve& operator=(const LentReserve&) = delete;

 private:
  MemoryRefusal before_;
  std::uint64_t bytes_;
};

// Returns the part of a budget that is kept free: for what threads take between two looks, and for an orderly
// end.
std::uint64_t memory_reserve(std::uint64_t budget_bytes);

}  // namespace vitrail
