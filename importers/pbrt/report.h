// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importers/pbrt/lexer.h"

namespace vitrail::pbrt {

// Collects diagnostics in the order of the file.
class Report {
 public:
  void approximated(const std::string& message, const Place& place) {
    add({Fidelity::approximated, message, location(place), {}});
  }
  void dropped(const std::string& message, const Place& place) {
    add({Fidelity::dropped, message, location(place), {}});
  }
  void add(Diagnostic diagnostic);
  // What comes is about the directive there.
  void begin_item(const Place& place) { item_ = place; }

  Diagnostics take() { return std::move(diagnostics_); }

 private:
  Place item_;
  Diagnostics diagnostics_;
};

}  // namespace vitrail::pbrt
