// SPDX-License-Identifier: Apache-2.0
// What a film is of, listed once: for those who tell films, or what ranks were asked for, apart.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail {

struct PictureField {
  const char* name;        // "depth"
  const char* difference;  // of two films, a sentence: "their depths differ"
  std::string value;       // in words; equal where the fields are
  bool is_shown = true;    // the values say more than the sentence
};

// All but the seed, which films of one picture may differ in. The filter is in the scene's hash.
std::vector<PictureField> picture_fields(const FilmKey& key, const FilmSettings& film);

}  // namespace vitrail
