// SPDX-License-Identifier: Apache-2.0
// A scene leaves these choices to those who load it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace vitrail {

// A scene that is a program, as POV-Ray's are, may ask for so much before it is refused. Each limit has its
// option.
struct ProgramLimits {
  std::uint64_t tokens = 2'000'000'000;     // --token-limit: read, again in each round of a loop
  std::uint64_t written_bytes = 256 << 20;  // --write-limit: by #write, kept in memory
  std::size_t open_calls = 20'000;          // --call-limit: macros, loops and files within each other
  int nested = 200;                         // --nesting-limit: objects and brackets within each other
};

// All readers take these options.
struct ImportOptions {
  // They are values of a Mitsuba scene's parameters, as its command line's -D: they stand before the file's
  // <default>s. For a POV-Ray scene they stand before it, as its command line's Declare=.
  std::map<std::string, std::string> definitions;
  bool replace_missing = false;  // go on without images and meshes that are not there (missing_files.h)
  std::string sky;  // in place of all light from infinitely far (given_sky.h); "": as the file says
  std::vector<std::string> glazing{};     // panes for materials (given_glazing.h); none: as the file says
  int camera = 0;                         // which of a Mitsuba scene's sensors, in the file's order, from 0
  std::uint64_t include_limit = 1 << 30;  // bytes of text that is included again (included_text.h)
  std::vector<std::string> include_folders;  // searched for files of a POV-Ray scene, after its own folder
  ProgramLimits program;
  bool all_media = false;  // also those that the scene's integrator passes by (pbrt's "path")
  // It is set for writers. Features that other formats do not have (the film's working gamma, highlights that
  // are not normalised) are then replaced by the nearest that they have.
  bool for_export = false;
};

}  // namespace vitrail
