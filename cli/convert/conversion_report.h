// SPDX-License-Identifier: Apache-2.0
// A conversion report says what became of each item of a converted scene.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// An item is a record of the scene, or a directive that made none. It is as inexact as its worst note.
struct ConversionItem {
  std::string what;  // "material \"floor\"", "shape", "sphere"
  SourceLocation location;
  std::vector<const Diagnostic*> notes;
};

// Returns the records of the scene in the order of their kinds, then other things that the diagnostics name.
// A diagnostic belongs to the records of its kind that come from its place: a material and its texture, from
// one place, are two items. The items refer to `diagnostics`.
std::vector<ConversionItem> conversion_items(const Scene& scene, const Diagnostics& diagnostics);

struct ConversionCounts {
  std::size_t exact = 0, approximated = 0, dropped = 0;  // items
};
// Returns "approximated" or "dropped".
const char* name_of(Fidelity fidelity);
// Returns "exact", "approximated" or "dropped".
const char* fidelity_of(const ConversionItem& item);
ConversionCounts count(const std::vector<ConversionItem>& items);

// ConversionChecks are the checks that were made; null where none was.
struct ConversionChecks {
  nlohmann::ordered_json pictures;  // check_conversion.h
  nlohmann::ordered_json peer;      // peer_check.h
};

// Writes {input, output, options, quadrics, pictures, peer (where there are some), exact, approximated,
// dropped, items: [{item, fidelity, file, line, column, notes: [{fidelity, what, file, line,
// column}]}]}. Throws MachineError.
void write_conversion_report(const std::filesystem::path& file, const std::filesystem::path& in,
                             const std::filesystem::path& out, const std::string& quadrics,
                             const std::vector<std::string>& options, const ConversionChecks& checks,
                             const std::vector<ConversionItem>& items);

}  // namespace vitrail
