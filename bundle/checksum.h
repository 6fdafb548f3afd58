// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace vitrail {

// Returns the 64-bit XXH3 with seed 0, which is the checksum of every file of a bundle.
std::uint64_t checksum(std::span<const std::byte> bytes);

// A Hasher gives the same checksum of bytes that come one part after the other.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add(std::span<const std::byte> bytes);
  std::uint64_t digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vitrail
