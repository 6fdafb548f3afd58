// SPDX-License-Identifier: Apache-2.0
#include "bundle/checksum.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace vitrail {

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

struct Hasher::State {
  XXH3_state_t xxh;
};

Hasher::Hasher() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->xxh); }
Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) {
  XXH3_64bits_update(&state_->xxh, bytes.data(), bytes.size());
}
std::uint64_t Hasher::digest() const { return XXH3_64bits_digest(&state_->xxh); }

}  // namespace vitrail
