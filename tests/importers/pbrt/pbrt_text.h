// SPDX-License-Identifier: Apache-2.0
// Scenes written in tests, and what is asked of them.
#pragma once

#include <gmock/gmock.h>

#include "importers/pbrt/read/pbrt.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail {

inline ImportedScene import_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_pbrt(folder.write("scene.pbrt", text));
}

// A world of v4 or v3, by the film.
inline ImportedScene import_v4(const std::string& world) {
  return import_text("Film \"rgb\"\nWorldBegin\n" + world);
}
inline ImportedScene import_v3(const std::string& world) {
  return import_text("Film \"image\"\nWorldBegin\n" + world + "\nWorldEnd\n");
}

// One triangle in the plane z = 0 whose winding normal is +z.
inline const std::string triangle =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]\n";

inline bool mentions(const Diagnostics& diagnostics, const std::string& words) {
  for (const Diagnostic& diagnostic : diagnostics)
    if (diagnostic.message.find(words) != std::string::npos) return true;
  return false;
}

inline void expect_no_diagnostics(const ImportedScene& imported) {
  for (const Diagnostic& diagnostic : imported.diagnostics)
    ADD_FAILURE() << to_string(diagnostic.location) << ": " << diagnostic.message;
}

}  // namespace vitrail
