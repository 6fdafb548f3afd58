// SPDX-License-Identifier: Apache-2.0
// These functions tell what is in memory while an .exr is made of a film that stays in its file.
#pragma once

#include <cstdint>

#include "film/film_key.h"
#include "scene/records/film_settings.h"

namespace vitrail {

inline constexpr int exr_block_rows = 16;  // of ZIP: they are compressed together

// Returns how many rows of the film are taken at once: some megabytes of them, one at least.
int rows_at_once(const FilmSettings& film, const FilmKey& key);

// Returns the bytes of merging `films` films: their rows, the picture of these, and a block of the file
// as it is, rearranged and compressed.
std::uint64_t exr_memory(const FilmSettings& film, const FilmKey& key, int films = 1);

}  // namespace vitrail
