// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/report.h"

#include <fmt/format.h>

namespace vitrail::pbrt {

void Report::add(Diagnostic diagnostic) {
  const auto [entry, added] = index_.try_emplace(diagnostic.message, diagnostics_.size());
  if (!added) {
    ++repetitions_[entry->second];
    return;
  }
  diagnostics_.push_back(std::move(diagnostic));
  repetitions_.push_back(0);
}

Diagnostics Report::take() {
  for (std::size_t i = 0; i < diagnostics_.size(); ++i)
    if (repetitions_[i] > 0) diagnostics_[i].message += fmt::format(" (and {} more)", repetitions_[i]);
  repetitions_.clear();
  index_.clear();
  return std::move(diagnostics_);
}

}  // namespace vitrail::pbrt
