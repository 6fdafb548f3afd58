// SPDX-License-Identifier: Apache-2.0
// A FilmKeeper writes the films of a job, so that no sample is lost to a disk that takes nothing.
#pragma once

#include <filesystem>
#include <string>

#include "farm/files/reserved_space.h"
#include "film/film_progress.h"

namespace vitrail {

class FilmKeeper {
 public:
  // Reserves room for one film of that size beside `film`. Throws MachineError where there is none.
  FilmKeeper(const std::filesystem::path& film, std::uint64_t bytes);

  // It is the number of seconds after which a checkpoint that could not be written is due again.
  static constexpr double retry_s = 60;
  // Returns false, and says why, where the checkpoint cannot be written: the last one stays.
  bool write_checkpoint(const std::filesystem::path& file, const Film& film, const FilmProgress& progress);

  // Writes the last film, after which none comes. Where it cannot be written it is tried again after 1 and
  // after 4 s (at once elsewhere if a signal wants an end). Then it goes to the current folder, to $TMPDIR or
  // to /tmp, under a name that is free there. Throws MachineError, which says where the film is, unless it is
  // in its place.
  void write_last(const std::filesystem::path& file, const Film& film, const FilmProgress& progress);

  // Returns the time that writing the last film takes, by a trial on its disk.
  double time_to_write_s() const { return reserved_.time_to_write_s(); }

 private:
  ReservedSpace reserved_;
};

}  // namespace vitrail
