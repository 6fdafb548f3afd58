// SPDX-License-Identifier: Apache-2.0
// A FilmReader reads a film file from its beginning to its sums. Only film_file.cpp and film_rows.cpp use it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "film/array_checksum.h"
#include "film/film_layout.h"
#include "film/film_progress.h"
#include "scene/system/input_files.h"

namespace vitrail {

// Throws Error, with the file, for what is not there or does not match its checksum.
class FilmReader {
 public:
  explicit FilmReader(const std::filesystem::path& file);

  [[noreturn]] void fail(const std::string& what) const;
  std::uint64_t size() const { return in_.size(); }
  const std::filesystem::path& path() const { return path_; }

  void read(void* to, std::uint64_t bytes);
  template <class Array>
  void read_array(Array& array, std::uint64_t count, const char* what, FilmScratch* scratch = nullptr) {
    array.resize(count);
    const std::uint64_t sum =
        checksum_of(std::span(array), scratch, [&](auto part) { read(part.data(), part.size_bytes()); });
    require_checksum(sum, what);
  }
  // Passes over an array, which `visit` sees part by part. Returns its checksum.
  template <class T, class Visit>
  std::uint64_t pass_array(std::uint64_t count, const char* what, Visit&& visit) {
    std::vector<T> part(std::min<std::uint64_t>(count, scratch_part_bytes / sizeof(T)));
    XXH3_state_t state;
    XXH3_64bits_reset(&state);
    for (std::uint64_t left = count; left > 0;) {
      const std::span<T> here(part.data(), std::min<std::uint64_t>(left, part.size()));
      read(here.data(), here.size_bytes());
      visit(here);
      XXH3_64bits_update(&state, here.data(), here.size_bytes());
      left -= here.size();
    }
    const std::uint64_t sum = XXH3_64bits_digest(&state);
    require_checksum(sum, what);
    return sum;
  }

  std::uint64_t place() const { return place_; }
  void go_to(std::uint64_t place) { place_ = place; }

 private:
  void require_checksum(std::uint64_t sum, const char* what);

  std::filesystem::path path_;
  RegularFile in_;
  std::uint64_t place_ = 0;
};

// A FilmHead is all that stands before the sums.
struct FilmHead {
  FilmSettings settings;
  FilmKey key;
  int exponent, length_exponent;
  Refused refused;
  film_layout::Arrays arrays;
  FilmProgress progress;  // without `more`, which comes last
};
FilmHead read_head(FilmReader& in);

}  // namespace vitrail
