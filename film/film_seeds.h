// SPDX-License-Identifier: Apache-2.0
// These functions tell the seeds of a film that was merged of several.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail {

// Returns the seeds in a merged film's description (FilmProgress::about), ascending, else the film's own.
std::vector<std::uint64_t> seeds_of(const Film& film, const std::string& about);

// Returns the description of a film that is merged of those of `seeds`.
std::string with_seeds(const std::string& about, std::span<const std::uint64_t> seeds);

// Returns the key's seed of such a film, a number above all that people choose, so that no render goes on
// from it. For a single seed it returns that seed.
std::uint64_t merged_seed(std::span<const std::uint64_t> seeds);

}  // namespace vitrail
