// SPDX-License-Identifier: Apache-2.0
// The readers of glazing files share these: whole small texts, lines, numbers. For glazing alone.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vitrail {

// Returns at most 64 MiB, as UTF-8: a byte-order mark is left out, and a text that is not UTF-8 counts as
// Latin-1. Throws Error, MachineError.
std::string read_text(const std::filesystem::path& file);

// Lines gives the lines of a text, counted from 1, without their ends.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line);
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);
bool same_word(std::string_view a, std::string_view b);  // whatever the case

// Takes the next word from `rest`: blanks, commas, semicolons and tabs separate. Empty at the end.
std::string_view next_word(std::string_view& rest);

// Returns how many nanometres a unit of wavelength has, by its name (nm, Nanometers, um, µm, Microns,
// micrometres …); 0 where it is none.
double nanometres_in(std::string_view unit);

// Reads the whole word as a finite number; returns false where it is none.
bool parse_number(std::string_view word, double& value);

}  // namespace vitrail
