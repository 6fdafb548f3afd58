// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/report.h"

#include <iterator>

namespace vitrail::mitsuba {

SourceLocation Report::location(const Origin& origin) const {
  if (origin.file >= files_.size()) return {};
  return {files_[origin.file], static_cast<int>(origin.line), static_cast<int>(origin.column)};
}

void Report::keep(Diagnostic diagnostic) {
  if (!repeated_ || repeated_->keeps(diagnostic)) diagnostics_.push_back(std::move(diagnostic));
}

void Report::add(Fidelity fidelity, std::string message, const Origin& place) {
  keep({fidelity, std::move(message), location(place), location(item_.origin), item_.kind});
}

void Report::add(Diagnostics more) {
  for (Diagnostic& diagnostic : more) {
    diagnostic.item = location(item_.origin);
    diagnostic.kind = item_.kind;
    keep(std::move(diagnostic));
  }
}

void Report::fail(const std::string& message, const Origin& place) const {
  throw Error(message, location(place));
}

}  // namespace vitrail::mitsuba
