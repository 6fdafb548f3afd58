// SPDX-License-Identifier: Apache-2.0
// The seeds of a film that was merged of several.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail {

// Those that a merged film's description (FilmProgress::about) says, ascending, else the film's own.
std::vector<std::uint64_t> seeds_of(const Film& film, const std::string& about);

// The description of a film that is merged of those of `seeds`.
std::string with_seeds(const std::string& about, std::span<const std::uint64_t> seeds);

// The key's seed of such a film, a number above all that people choose, so that no render goes on from it; of
// one seed that seed.
std::uint64_t merged_seed(std::span<const std::uint64_t> seeds);

}  // namespace vitrail
