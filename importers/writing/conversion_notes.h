// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <tuple>

#include "scene/records/scene.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

// They say what a written file does not say exactly of a scene, each message once a place and kind of record.
class ConversionNotes {
 public:
  explicit ConversionNotes(const Scene& of) : scene(of) {}

  const Scene& scene;
  // It is what is being written: messages without an origin are about it.
  Origin origin;
  RecordKind record = RecordKind::any;
  void begin(RecordKind of, const Origin& from) { record = of, origin = from; }

  void note(Fidelity fidelity, std::string message, const Origin& of, RecordKind kind = RecordKind::any);
  void approximated(std::string message) { note(Fidelity::approximated, std::move(message), origin, record); }
  void approximated(std::string message, const Origin& of, RecordKind kind = RecordKind::any) {
    note(Fidelity::approximated, std::move(message), of, kind);
  }
  void dropped(std::string message) { note(Fidelity::dropped, std::move(message), origin, record); }
  void dropped(std::string message, const Origin& of, RecordKind kind = RecordKind::any) {
    note(Fidelity::dropped, std::move(message), of, kind);
  }
  // Returns all diagnostics, in the order in which they were made.
  Diagnostics take() { return std::move(diagnostics_); }

 private:
  Diagnostics diagnostics_;
  std::set<std::tuple<std::string, std::string, RecordKind, Fidelity>> noted_;
};

}  // namespace vitrail
