// SPDX-License-Identifier: Apache-2.0
// Grouped notes say what is not exact, by importance, equal notes together.
#pragma once

#include <string>
#include <vector>

#include "scene/system/diagnostics.h"

namespace vitrail {

// A NoteGroup has notes of one kind of record that say the same, whatever the record is called: `material
// "wood": …` and `material "tin": …`.
struct NoteGroup {
  Fidelity fidelity = Fidelity::approximated;
  RecordKind kind = RecordKind::any;
  std::string message;  // of the first
  std::vector<SourceLocation> places;
};

// Returns all notes: dropped things first, then approximated ones. In each, what changes the whole picture
// comes first (camera, integrator, film, lights, media), then materials and textures, then shapes.
std::vector<NoteGroup> grouped_notes(const Diagnostics& diagnostics);

}  // namespace vitrail
