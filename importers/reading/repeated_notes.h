// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "scene/system/diagnostics.h"

namespace vitrail {

// It limits the notes that say the same of very many places, where memory is limited: each takes 300 bytes.
// The first notes of a text are kept with their places, the others are counted.
class RepeatedNotes {
 public:
  static constexpr std::uint64_t most_places = 1024;

  // Returns whether the note is to be kept. Counts it otherwise.
  bool keeps(const Diagnostic& note) {
    const std::size_t text = 2 * std::hash<std::string>{}(note.message) +
                             static_cast<std::size_t>(note.fidelity == Fidelity::dropped);
    if (++places_[text] <= most_places) return true;
    beyond_.try_emplace(text, note);
    return false;
  }

  // Appends a note on each text that was counted, at the first place that is not kept.
  void append_counts(Diagnostics& notes) {
    for (auto& [text, note] : std::exchange(beyond_, {})) {
      note.message += fmt::format(" (counted alone: {} places)", places_[text] - most_places);
      notes.push_back(std::move(note));
    }
  }

 private:
  std::unordered_map<std::size_t, std::uint64_t> places_;  // by a hash of the text
  std::map<std::size_t, Diagnostic> beyond_;
};

}  // namespace vitrail
