// SPDX-License-Identifier: Apache-2.0
#include "scene/system/within_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

constexpr double mib = 1 << 20;

// All of what a scene takes, where so much of it is read.
double extrapolated(double resident, const Stage& stage) {
  const bool partly = stage.fraction > 0.01 && stage.fraction < 0.99;
  return partly ? stage.start_bytes + (resident - stage.start_bytes) / stage.fraction : resident;
}

// What was asked for, in two digits; more while the scene is read, for what comes after it is not known.
double enough_bytes(const MemoryRefusal& refusal, double budget, const Stage& stage) {
  const double resident = extrapolated(static_cast<double>(refusal.resident_bytes), stage);
  double needed = std::max(resident + static_cast<double>(refusal.asked_bytes), budget);
  needed += static_cast<double>(memory_reserve(static_cast<std::uint64_t>(needed)));
  if (stage.needed_bytes > 0) return std::max(needed, static_cast<double>(stage.needed_bytes));
  needed *= 2;
  const double digit = mib * std::pow(10, std::max(0.0, std::floor(std::log10(needed / mib)) - 1));
  return std::ceil(needed / digit) * digit;
}

}  // namespace

int within_memory(std::uint64_t budget_bytes, const Stage& stage, const std::function<int()>& body,
                  bool (*is_own)()) {
  guard_memory(budget_bytes, is_own);
  // What ends after this, static objects of libraries too, is refused nothing.
  const struct End {
    ~End() { guard_no_more(); }
  } end;
  try {
    return body();
  } catch (const MemoryNeeded&) {
    throw;
  } catch (...) {
    guard_no_more();
    const MemoryRefusal refusal = memory_refusal();
    if (!refusal.refused) throw;
    throw MemoryNeeded(
        budget_bytes,
        static_cast<std::uint64_t>(enough_bytes(refusal, static_cast<double>(budget_bytes), stage)),
        stage.held.empty() ? stage.what : fmt::format("{} ({})", stage.what, stage.held));
  }
}

void within_job(std::uint64_t job_bytes, const char* what, const std::function<void()>& body) {
  if (job_bytes == 0) return body();
  try {
    within_memory(job_bytes, {what}, [&] { return body(), 0; });
  } catch (const MemoryNeeded& e) {
    throw MachineError(fmt::format("{}, and give the job more than that", e.what()));
  }
}

}  // namespace vitrail
