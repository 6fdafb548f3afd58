// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "importers/pbrt/lexer.h"

namespace vitrail::pbrt {

// Collects diagnostics in the order of the file. A message that comes again is counted, not repeated: the
// place is that of its first occurrence.
class Report {
 public:
  void approximated(const std::string& message, const Place& place) {
    add({Fidelity::approximated, message, location(place)});
  }
  void dropped(const std::string& message, const Place& place) {
    add({Fidelity::dropped, message, location(place)});
  }
  void add(Diagnostic diagnostic);

  // All of them, with " (and N more)" where a message came again. Leaves the report empty.
  Diagnostics take();

 private:
  Diagnostics diagnostics_;
  std::vector<int> repetitions_;
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace vitrail::pbrt
