// SPDX-License-Identifier: Apache-2.0
// What a scene leaves to those who load it.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace vitrail {

// The options of a reader.
struct ImportOptions {
  // Values of a Mitsuba scene's parameters, as its command line's -D: they stand before the file's
  // <default>s.
  std::map<std::string, std::string> definitions;
  bool replace_missing = false;  // go on without images and meshes that are not there (missing_files.h)
  std::string sky;  // in place of all light from infinitely far (given_sky.h); "": as the file says
  int camera = 0;   // which of a Mitsuba scene's sensors, in the file's order, from 0
  std::uint64_t include_limit = 1 << 30;  // bytes of text that is included again (included_text.h)
};

}  // namespace vitrail
