// SPDX-License-Identifier: Apache-2.0
// Picture fields list once what a film is of, to tell films, or what ranks were asked for, apart.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail {

// It is as great as a path can have it (max_path_depth): a depth from here on limits nothing.
inline constexpr int no_limit_of_depth = (1 << 16) - 1;

// Returns "5" or "no limit".
std::string words_of_depth(int depth);

struct PictureField {
  const char* name;        // "depth"
  const char* difference;  // of two films, a sentence: "their depths differ"
  std::string value;       // in words; equal where the fields are
  bool is_shown = true;    // the values say more than the sentence
};

// Returns the fields, the scene first, all but the seed, which films of one picture may differ in.
// The filter is in the scene's hash.
std::vector<PictureField> picture_fields(const FilmKey& key, const FilmSettings& film);

// SumsOf says what the sums of a film are of.
struct SumsOf {
  const FilmKey& key;
  const FilmSettings& settings;
  int exponent, length_exponent;
};

// Returns the difference as for films (film.h).
std::string difference(const SumsOf& a, const SumsOf& b);

}  // namespace vitrail
