// SPDX-License-Identifier: Apache-2.0
// A FilmSurvey is what a picture says of its film as a whole, found in one pass over its rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "film/film.h"

namespace vitrail {

struct FilmSurvey {
  struct Mattes {
    std::size_t most = 1;          // things of one pixel, as matte_channels counts them
    double covered = 0, kept = 0;  // by all things, and by those that have a place
  };
  std::uint64_t samples = 0;                                          // of all pixels
  std::uint64_t most_samples = 0, least_samples = ~std::uint64_t{0};  // of a pixel
  std::array<Mattes, layer_count> mattes;                             // by layer
  WideSum light;           // of a film with a clamp, the Y that is left
  std::uint64_t hash = 0;  // Film::hash
};

// Adds rows from the top down. The caller sets the hash.
void add_rows(FilmSurvey& survey, const Film& rows);

// Returns the survey of a whole film.
FilmSurvey survey_of(const Film& film);

// Returns Film::clamped_share; `rows` are any of the film.
double clamped_share(const FilmSurvey& survey, const Film& rows);

// Returns the part of things' coverage that has no mask, as pixels show more than most_mattes things.
double share_without_matte(const FilmSurvey& survey, Layer layer);

}  // namespace vitrail
