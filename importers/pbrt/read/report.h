// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "importers/pbrt/read/lexer.h"
#include "importers/reading/repeated_notes.h"

namespace vitrail::pbrt {

// It collects diagnostics in the order of the file.
class Report {
 public:
  void approximated(const std::string& message, const Place& place) {
    add({Fidelity::approximated, message, location(place), {}});
  }
  void dropped(const std::string& message, const Place& place) {
    add({Fidelity::dropped, message, location(place), {}});
  }
  void add(Diagnostic diagnostic);
  // Diagnostics that follow are about the directive at `place`, of which a record of that kind is made.
  void begin_item(const Place& place, RecordKind kind = RecordKind::any) { item_ = place, kind_ = kind; }

  // Makes the report count most of very many notes of one text alone.
  void count_repeated() { repeated_.emplace(); }

  Diagnostics take() {
    if (repeated_) repeated_->append_counts(diagnostics_);
    return std::move(diagnostics_);
  }

 private:
  Place item_;
  RecordKind kind_ = RecordKind::any;
  std::optional<RepeatedNotes> repeated_;
  Diagnostics diagnostics_;
};

}  // namespace vitrail::pbrt
