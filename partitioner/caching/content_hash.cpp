// SPDX-License-Identifier: Apache-2.0
#include "partitioner/caching/content_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace vitrail {

struct ContentHash::State {
  XXH3_state_t xxh;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) { XXH3_128bits_reset(&state_->xxh); }
ContentHash::~ContentHash() = default;

void ContentHash::add_bytes(std::span<const std::byte> bytes) {
  XXH3_128bits_update(&state_->xxh, bytes.data(), bytes.size());
}

void ContentHash::add(std::string_view text) { add(std::as_bytes(std::span(text))); }

void ContentHash::add(std::span<const std::byte> bytes) {
  const std::uint64_t size = bytes.size();
  add_bytes(std::as_bytes(std::span(&size, 1)));
  add_bytes(bytes);
}

void ContentHash::add_content(const std::filesystem::path& file) {
  const RegularFile in(file);
  const std::uint64_t size = in.size();
  add_bytes(std::as_bytes(std::span(&size, 1)));
  std::vector<std::byte> part(std::min<std::uint64_t>(size, 1 << 20));
  for (std::uint64_t at = 0; at < size; at += part.size()) {
    part.resize(std::min<std::uint64_t>(part.size(), size - at));
    if (!in.read(part, at)) throw Error("cannot be read", {file.string()});
    add_bytes(part);
  }
  if (!in.is_open()) throw Error("cannot be read", {file.string()});
}

std::string ContentHash::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace vitrail
