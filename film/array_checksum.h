// SPDX-License-Identifier: Apache-2.0
// These functions take the xxh3 of an array of a film, which may lie in its scratch.
#pragma once

#ifndef XXH_INLINE_ALL
#define XXH_INLINE_ALL
#endif
#include <xxhash.h>

#include <array>
#include <cstdint>
#include <span>

#include "film/film_scratch.h"

namespace vitrail {

// Returns the checksum of an array, visited part by part: `visit` sees each part before it counts.
template <class T, class Visit>
std::uint64_t checksum_of(std::span<T> array, FilmScratch* scratch, Visit&& visit) {
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  in_parts(array, scratch, [&](std::span<T> part) {
    visit(part);
    XXH3_64bits_update(&state, part.data(), part.size_bytes());
  });
  return XXH3_64bits_digest(&state);
}
template <class T>
std::uint64_t checksum_of(std::span<T> array, FilmScratch* scratch) {
  return checksum_of(array, scratch, [](std::span<T>) {});
}

// Returns a film's hash, that of the checksums of its sums, counts, ids and mattes.
inline std::uint64_t hash_of_arrays(const std::array<std::uint64_t, 4>& checksums, bool has_ids,
                                    bool has_mattes) {
  const std::size_t used = has_mattes ? 4 : has_ids ? 3 : 2;
  return XXH3_64bits(checksums.data(), used * sizeof checksums[0]);
}

}  // namespace vitrail
