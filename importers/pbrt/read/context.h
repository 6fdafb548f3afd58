// SPDX-License-Identifier: Apache-2.0
// Every part of the import of one file shares this context.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "importers/pbrt/read/report.h"
#include "importers/pbrt/read/version.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::pbrt {

// They count what a reading without the long lists leaves out.
struct SkimCounts {
  std::uint64_t grid_bytes = 0;       // of values of grids
  std::uint64_t statement_bytes = 0;  // most that is held while one statement is read
};

struct Context {
  Version version = Version::v4;
  bool version_is_certain = true;
  bool replace_missing = false;     // leave out meshes that are not there
  bool all_media = false;           // keep those that the integrator passes by
  std::filesystem::path directory;  // of the main file
  Report report;
  MeshMemory mesh_memory;
  std::function<void(double)> progress;                   // gets the fraction that is read
  std::optional<SkimCounts> skim;                         // the long lists are counted alone
  std::function<std::string_view(std::size_t)> upcoming;  // text of the file, up to so many bytes

  // Reports what v3 and v4 take differently, in a file that does not tell which it is.
  void note_version(const char* what, const Place& place) {
    if (!version_is_certain)
      report.approximated(
          std::string("nothing tells whether the file is of pbrt-v3 or v4: ") + what + " is read as v4 does",
          place);
  }

  // Returns where a file that the scene names is: beside the main file, or in the working directory. A name
  // of Windows that no file has is taken with slashes.
  std::filesystem::path resolve(const std::string& name) const;
};

}  // namespace vitrail::pbrt
