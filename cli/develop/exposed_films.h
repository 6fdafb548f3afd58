// SPDX-License-Identifier: Apache-2.0
// Exposed holds the films that a picture is made of, as one.
#pragma once

#include <optional>

#include "cli/develop/develop_arguments.h"
#include "film/develop.h"
#include "film/film_rows.h"

namespace vitrail {

struct Exposed {
  std::filesystem::path file;
  Film film;  // the sum; of films that stay in their files, of which `parts` are: its first row
  std::vector<FilmRows> parts{};  // in the order of their seeds
  double render_time_s = 0;
  std::uint64_t samples_per_pixel = 0;
  bool adaptive = false, complete = true;
  std::string about;
  std::vector<std::uint64_t> seeds;  // ascending
};

// Merges the films of the command line in the order of their seeds, whatever their order there. If
// `in_files`, they stay in their files. Throws Error where they are not of one picture, or share a seed.
Exposed merge_all(const DevelopArguments& arguments, bool in_files);

// MergedRows are rows of films in files, merged, from the top down, some megabytes at a time.
class MergedRows {
 public:
  // They go from row `y0` of the crop on, up to `y1`. `with_sums` is that of FilmRows::rows.
  MergedRows(const Exposed& films, int y0, int y1, bool with_sums = true);
  // Returns the next rows; none means that was all.
  std::optional<Film> next();

 private:
  const Exposed& films_;
  int y_, end_, step_;
  bool with_sums_;
};

// Surveys the film in one pass.
FilmSurvey survey_of(const Exposed& film);

// Adds what the render knew of scene and camera, and which films it is made of.
void tell_origin(Picture& picture, const Exposed& film);

// Writes it as a film of its own. Its seed is a number made of all seeds, so that no render goes on from it.
// Its description has the seeds themselves, and it merges with films of others. Throws Error where it is not
// finished, or the file is there.
void write_merged(const std::filesystem::path& file, const Exposed& film);

}  // namespace vitrail
