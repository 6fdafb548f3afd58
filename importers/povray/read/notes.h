// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>

#include "scene/system/diagnostics.h"

namespace vitrail::pov {

// It has diagnostics in the order of the file. Loops and macros read one place again and again: each message
// about a place is kept once.
class Notes {
 public:
  void approximated(const std::string& message, const SourceLocation& place) {
    add({Fidelity::approximated, message, place, place});
  }
  void dropped(const std::string& message, const SourceLocation& place) {
    add({Fidelity::dropped, message, place, place});
  }
  void add(Diagnostic diagnostic) {
    if (said_.insert({to_string(diagnostic.location), diagnostic.message}).second)
      diagnostics_.push_back(std::move(diagnostic));
  }
  Diagnostics take() { return std::move(diagnostics_); }

 private:
  std::set<std::pair<std::string, std::string>> said_;
  Diagnostics diagnostics_;
};

}  // namespace vitrail::pov
