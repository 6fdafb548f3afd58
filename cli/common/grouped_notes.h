// SPDX-License-Identifier: Apache-2.0
// What is not exact, by importance: equal notes together.
#pragma once

#include <string>
#include <vector>

#include "scene/system/diagnostics.h"

namespace vitrail {

// Notes of one kind of record that say the same, whatever the record is called: `material "wood": …` and
// `material "tin": …`.
struct NoteGroup {
  Fidelity fidelity = Fidelity::approximated;
  RecordKind kind = RecordKind::any;
  std::string message;  // of the first
  std::vector<SourceLocation> places;
};

// What is dropped first, then what is approximated; each with what changes the whole picture first (camera,
// integrator, film, lights, media), then materials and textures, then shapes. All of them.
std::vector<NoteGroup> grouped_notes(const Diagnostics& diagnostics);

}  // namespace vitrail
