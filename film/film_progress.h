// SPDX-License-Identifier: Apache-2.0
// The film's file holds a film, and which samples it has, so that it is a checkpoint too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "film/film.h"

namespace vitrail {

// FilmProgress says which samples a film holds: bit i of `done` is work item i of `items` (see
// farm/plan/work.h). A finished film has all.
struct FilmProgress {
  std::uint64_t items = 0;
  std::uint64_t samples_per_pixel = 0;
  std::vector<std::uint64_t> done;  // ⌈items/64⌉ words
  double render_time_s = 0;
  // They are the ends, in samples a pixel, of renders that this one goes on from, whose items come first (see
  // farm/plan/work.h). They ascend, below samples_per_pixel; they are empty once all items are done.
  std::vector<std::uint32_t> earlier_ends;
  std::string about;  // the scene and how it is seen, as JSON, for those who read pictures; "" where unknown
  // Pixels have samples of their own numbers if true. `items` are then those of the open round
  // alone, in which each pixel is to have `more`; between rounds there are none. samples_per_pixel
  // is the mean, rounded up.
  bool adaptive = false;
  std::vector<std::uint32_t> more;
  bool complete() const;
};

// Writes under a temporary name, syncs and renames. Throws MachineError.
void write_film(const std::filesystem::path& file, const Film& film, const FilmProgress& progress);
// Throws Error for anything but a whole, checksummed film of this version. `progress` may be null. The film's
// sums lie in `scratch` if not in memory.
Film read_film(const std::filesystem::path& file, FilmProgress* progress,
               std::shared_ptr<FilmScratch> scratch = nullptr);

}  // namespace vitrail
