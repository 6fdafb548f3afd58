// SPDX-License-Identifier: Apache-2.0
#include "cli/diagnostics_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrail {

namespace {

constexpr std::size_t shown_of_each = 5;

std::string summarise(const Diagnostics& diagnostics, Fidelity fidelity, const char* word) {
  const auto count = static_cast<std::size_t>(std::count_if(
      diagnostics.begin(), diagnostics.end(), [&](const auto& d) { return d.fidelity == fidelity; }));
  if (count == 0) return {};
  std::string text = fmt::format("{} {}:\n", count, word);
  std::size_t shown = 0;
  for (const Diagnostic& d : diagnostics) {
    if (d.fidelity != fidelity || shown == shown_of_each) continue;
    const std::string place = to_string(d.location);
    text += fmt::format("  {}{}{}\n", place, place.empty() ? "" : ": ", d.message);
    ++shown;
  }
  if (count > shown) text += fmt::format("  and {} more\n", count - shown);
  return text;
}

}  // namespace

std::string summarise(const Diagnostics& diagnostics) {
  return summarise(diagnostics, Fidelity::dropped, "dropped") +
         summarise(diagnostics, Fidelity::approximated, "approximated");
}

void require_exact(const Diagnostics& diagnostics) {
  if (!diagnostics.empty())
    throw Error("not imported exactly, as --strict asks: " + diagnostics[0].message, diagnostics[0].location);
}

}  // namespace vitrail
