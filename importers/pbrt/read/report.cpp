// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/report.h"

namespace vitrail::pbrt {

void Report::add(Diagnostic diagnostic) {
  if (item_.file) diagnostic.item = location(item_), diagnostic.kind = kind_;
  if (!repeated_ || repeated_->keeps(diagnostic)) diagnostics_.push_back(std::move(diagnostic));
}

}  // namespace vitrail::pbrt
