// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "importers/reading/repeated_notes.h"
#include "scene/records/scene.h"

namespace vitrail::mitsuba {

// It collects diagnostics and throws errors, with their places.
class Report {
 public:
  explicit Report(const std::vector<std::string>& files) : files_(files) {}

  // Diagnostics that follow are about the object at `origin`, of which a record of that kind is made. Returns
  // what they were about before.
  struct Item {
    Origin origin;
    RecordKind kind = RecordKind::any;
  };
  Item begin_item(const Item& item) { return std::exchange(item_, item); }
  void approximated(std::string message, const Origin& place) {
    add(Fidelity::approximated, std::move(message), place);
  }
  void dropped(std::string message, const Origin& place) {
    add(Fidelity::dropped, std::move(message), place);
  }
  void add(Diagnostics more);

  [[noreturn]] void fail(const std::string& message, const Origin& place) const;
  SourceLocation location(const Origin& origin) const;
  // Makes the report count most of very many notes of one text alone.
  void count_repeated() { repeated_.emplace(); }
  Diagnostics take() {
    if (repeated_) repeated_->append_counts(diagnostics_);
    return std::move(diagnostics_);
  }

 private:
  void keep(Diagnostic diagnostic);
  void add(Fidelity fidelity, std::string message, const Origin& place);

  const std::vector<std::string>& files_;
  Item item_;
  std::optional<RepeatedNotes> repeated_;
  Diagnostics diagnostics_;
};

}  // namespace vitrail::mitsuba
