// SPDX-License-Identifier: Apache-2.0
#include "cli/common/within_memory.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

constexpr double mib = 1 << 20;

// What comes after this moment is not known, and takes more: of two digits. Twice as much while the scene is
// read, whose triangles are then sorted.
std::uint64_t ample_mib(double needed_mib, const Stage& stage) {
  const bool reads = std::string_view(stage.what) == "reading the scene";
  const double more = needed_mib * (reads ? 2 : 1.5),
               digit = std::pow(10, std::max(0.0, std::floor(std::log10(more)) - 1));
  return static_cast<std::uint64_t>(std::ceil(more / digit) * digit);
}

std::string message(const MemoryRefusal& refusal, double budget, const Stage& stage) {
  const auto resident = static_cast<double>(refusal.resident_bytes);
  // What was asked for, and the guard's reserve.
  double needed = std::max(resident + static_cast<double>(refusal.asked_bytes), budget) * (1 + 1.0 / 64);
  const bool partly = stage.fraction > 0.01 && stage.fraction < 0.99;
  if (partly) needed = std::max(needed, resident / stage.fraction);
  return fmt::format(
      "{:.0f} MiB of memory are too little: {} {:.0f} MiB is needed ({:.0f} MiB are in use and {:.1f} MiB "
      "more are needed, {}{}{}); try --memory {}M: later stages take more",
      budget / mib, partly ? "about" : "at least", std::ceil(needed / mib) + 1, resident / mib,
      static_cast<double>(refusal.asked_bytes) / mib, stage.what,
      partly ? fmt::format(" at {:.0f} % of it", 100 * stage.fraction) : "",
      stage.held.empty() ? "" : "; the scene has " + stage.held, ample_mib(needed / mib, stage));
}

}  // namespace

int within_memory(std::uint64_t budget_bytes, const Stage& stage, const std::function<int()>& body) {
  guard_memory(budget_bytes);
  try {
    return body();
  } catch (...) {
    const MemoryRefusal refusal = memory_refusal();
    if (!refusal.refused) throw;
    throw MachineError(message(refusal, static_cast<double>(budget_bytes), stage));
  }
}

}  // namespace vitrail
