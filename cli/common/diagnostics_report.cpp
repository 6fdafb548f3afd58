// SPDX-License-Identifier: Apache-2.0
#include "cli/common/diagnostics_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace vitrail {

namespace {

constexpr std::size_t shown_of_each = 5;

std::string summarise(const Diagnostics& diagnostics, Fidelity fidelity, const char* word) {
  const auto count = static_cast<std::size_t>(std::count_if(
      diagnostics.begin(), diagnostics.end(), [&](const auto& d) { return d.fidelity == fidelity; }));
  if (count == 0) return {};
  std::map<std::string_view, std::size_t> times;  // that a message comes
  for (const Diagnostic& d : diagnostics)
    if (d.fidelity == fidelity) ++times[d.message];
  std::string text = fmt::format("{} {}:\n", count, word);
  std::size_t shown = 0;
  std::set<std::string_view> seen;
  for (const Diagnostic& d : diagnostics) {
    if (d.fidelity != fidelity || seen.size() == shown_of_each || !seen.insert(d.message).second) continue;
    const std::string place = to_string(d.location);
    const std::size_t more = times[d.message] - 1;
    text += fmt::format("  {}{}{}{}\n", place, place.empty() ? "" : ": ", d.message,
                        more ? fmt::format(" (and {} more)", more) : "");
    shown += more + 1;
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
