// SPDX-License-Identifier: Apache-2.0
// WorkWords say what a film is of. By them a film, or a picture whose film is gone, tells in what it differs
// from what a command asks for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "farm/plan/options.h"
#include "film/film.h"

namespace vitrail {

struct WorkWords {
  std::uint64_t scene_hash = 0;
  std::string about;                                        // FilmProgress's
  std::vector<std::pair<std::string, std::string>> fields;  // {"depth", "5"}, …: all but the scene
};

// Returns the words for a film with this key and these settings: picture_fields, and the seed.
WorkWords words_of_work(const FilmKey& key, const FilmSettings& film, std::string about);

// Describes the film that the options ask for, and says how many samples that is to have. `bundle` is its
// manifest. Throws as read_job_manifest does.
WorkWords words_of_work(const RenderOptions& options, const Manifest& bundle);

// Returns in what the asked work is another: "depth: 3, this command has 4; …"; "" where it is the same.
std::string differences(const WorkWords& held, const WorkWords& asked);

}  // namespace vitrail
