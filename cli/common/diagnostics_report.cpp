// SPDX-License-Identifier: Apache-2.0
#include "cli/common/diagnostics_report.h"

#include <fmt/format.h>

#include "cli/common/grouped_notes.h"

namespace vitrail {

std::string summarise(const Diagnostics& diagnostics) {
  std::string text;
  const char* heading = "";
  for (const NoteGroup& group : grouped_notes(diagnostics)) {
    const char* word = group.fidelity == Fidelity::dropped ? "dropped:\n" : "approximated:\n";
    if (heading != std::string_view(word)) text += heading = word;
    const std::string place = to_string(group.places.front());
    const std::size_t more = group.places.size() - 1;
    text += fmt::format("  {}{}{}{}\n", place, place.empty() ? "" : ": ", group.message,
                        more ? fmt::format(" (and {} more)", more) : "");
  }
  return text;
}

void require_exact(const Diagnostics& diagnostics) {
  if (!diagnostics.empty())
    throw Error("not imported exactly, which --strict refuses: " + diagnostics[0].message,
                diagnostics[0].location);
}

}  // namespace vitrail
