// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/conversion_notes.h"

namespace vitrail {

void ConversionNotes::note(Fidelity fidelity, std::string message, const Origin& of, RecordKind kind) {
  const SourceLocation place = location(scene, of);
  if (noted_.insert({to_string(place), message, kind, fidelity}).second)
    diagnostics_.push_back({fidelity, std::move(message), place, place, kind});
}

}  // namespace vitrail
