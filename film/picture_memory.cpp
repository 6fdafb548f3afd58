// SPDX-License-Identifier: Apache-2.0
#include "film/picture_memory.h"

#include <algorithm>

#include "film/film.h"

namespace vitrail {

namespace {

std::uint64_t bytes_of_rows(FilmSettings film, const FilmKey& key, int rows) {
  film.crop.y1 = film.crop.y0 + rows;
  return film_bytes(film, key);
}

}  // namespace

int rows_at_once(const FilmSettings& film, const FilmKey& key) {
  constexpr std::uint64_t most_bytes = 4 << 20;
  const int most_rows = std::min(exr_block_rows, film.crop.y1 - film.crop.y0);
  return static_cast<int>(std::clamp<std::uint64_t>(most_bytes / bytes_of_rows(film, key, 1), 1,
                                                    static_cast<std::uint64_t>(most_rows)));
}

std::uint64_t exr_memory(const FilmSettings& film, const FilmKey& key, int films) {
  const std::uint64_t colours = 3, of_mattes = 2 * most_mattes,
                      channels = colours + static_cast<std::uint64_t>(film.spectrum.count) +
                                 sum_planes(film.layers) + id_planes(film.layers) +
                                 of_mattes * matte_planes(film.layers) +
                                 planes_a_group * key.groups.names.size();
  const std::uint64_t a_row =
      channels * sizeof(float) * static_cast<std::uint64_t>(film.crop.x1 - film.crop.x0);
  const int rows = rows_at_once(film, key);
  constexpr std::uint64_t block = std::uint64_t{3} * exr_block_rows;
  return bytes_of_rows(film, key, rows) * static_cast<std::uint64_t>(std::min(films, 2) + 1) +
         a_row * (2 * static_cast<std::uint64_t>(rows) + 1 + block);
}

}  // namespace vitrail
