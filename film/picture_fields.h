// SPDX-License-Identifier: Apache-2.0
// What a film is of, listed once: for those who tell films, or what ranks were asked for, apart.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail {

// As great as a path can have it (max_path_depth): a depth from here on limits nothing.
inline constexpr int no_limit_of_depth = (1 << 16) - 1;

// "5", "no limit".
std::string words_of_depth(int depth);

struct PictureField {
  const char* name;        // "depth"
  const char* difference;  // of two films, a sentence: "their depths differ"
  std::string value;       // in words; equal where the fields are
  bool is_shown = true;    // the values say more than the sentence
};

// The scene first. All but the seed, which films of one picture may differ in. The filter is in the scene's
// hash.
std::vector<PictureField> picture_fields(const FilmKey& key, const FilmSettings& film);

// What the sums of a film are of.
struct SumsOf {
  const FilmKey& key;
  const FilmSettings& settings;
  int exponent, length_exponent;
};

// As of films (film.h).
std::string difference(const SumsOf& a, const SumsOf& b);

}  // namespace vitrail
