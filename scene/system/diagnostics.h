// SPDX-License-Identifier: Apache-2.0
// These are messages to the user about the input: errors that stop, and notes on approximated and dropped
// records.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace vitrail {

// It is a place in a file. Lines and columns count from 1; 0 means that the file as a whole is meant.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

// Returns "file:line:column", "file" where the line is 0, "" where the file is unknown.
std::string to_string(const SourceLocation& where);

// It reports bad input: exit status 3. It is thrown anywhere and caught once in cli/. `excerpt` is the
// offending text, shown under the message; it may be empty.
struct Error : std::runtime_error {
  // The arguments say what is wrong, where, and which text is there.
  Error(const std::string& message, SourceLocation where = {}, std::string excerpt = {});
  SourceLocation location;
  std::string excerpt;
};

// It says that the machine failed: disk full, unwritable directory, too little memory, a lost rank. The exit
// status is 4.
struct MachineError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// It reports wrong usage of a program. The exit status is 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Fidelity { approximated, dropped };

// It names the records of a Scene that a diagnostic may be about.
enum class RecordKind : std::uint8_t {
  any,  // all that come from that place
  camera,
  film,
  sampler,
  integrator,
  texture,
  material,
  medium,
  area_light,
  light,
  shape,
  object,
  instance,
};

// It describes one feature of the input that was not imported exactly.
struct Diagnostic {
  Fidelity fidelity = Fidelity::approximated;
  std::string message;  // what, and how or why
  SourceLocation location;
  SourceLocation item;  // the directive or element that it is about, where a record's Origin points to
  RecordKind kind = RecordKind::any;  // of that record: several may come from one place
};

using Diagnostics = std::vector<Diagnostic>;

// Returns the closest of `candidates` to `word` by edit distance, or "" when none is within a third of its
// length.
std::string closest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace vitrail
