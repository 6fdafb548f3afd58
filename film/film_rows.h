// SPDX-License-Identifier: Apache-2.0
// FilmRows is a film that stays in its file, of which some rows at a time are in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "film/film.h"
#include "film/film_progress.h"

namespace vitrail {

class FilmReader;

class FilmRows {
 public:
  // Reads all of the file once. Throws Error as read_film does. `progress` may be null.
  FilmRows(const std::filesystem::path& file, FilmProgress* progress);
  ~FilmRows();
  FilmRows(FilmRows&&) noexcept;
  FilmRows& operator=(FilmRows&&) noexcept;

  const std::filesystem::path& file() const;
  std::uint64_t samples() const;  // of all pixels
  // They return the same as those of Film.
  const FilmSettings& settings() const;
  const FilmKey& key() const;
  const Refused& refused() const;
  std::size_t pixels() const;  // of the crop
  int height() const { return settings().crop.y1 - settings().crop.y0; }

  // Returns a film whose crop is these rows of the crop, counted from 0. Its sums beside the planes are those
  // of the whole. If `with_sums` is false, all sums are 0.
  Film rows(int y0, int y1, bool with_sums = true) const;

 private:
  friend std::string difference(const FilmRows& a, const FilmRows& b);
  friend std::uint64_t hash_of(std::span<const FilmRows> films);
  struct Contents;
  std::unique_ptr<Contents> contents_;
};

// Returns the difference as for films (film.h).
std::string difference(const FilmRows& a, const FilmRows& b);

// Returns Film::hash of the films merged in this order.
std::uint64_t hash_of(std::span<const FilmRows> films);

}  // namespace vitrail
