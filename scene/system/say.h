// SPDX-License-Identifier: Apache-2.0
// These functions print what a program says to its user.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace vitrail {

// Returns how many bytes the well-formed UTF-8 character takes that `text`, which is not empty, begins with
// (Unicode 15, table 3-7); 0 if there is none.
std::size_t utf8_size(std::string_view text);

// Returns the text in a form that is safe on a terminal, whatever a scene calls its things. Control
// characters, those that turn the direction of what follows, and bytes that are not UTF-8 are written out
// ("\u001b", "\xff"). If `lines`, line feeds and tabs stay as they are.
std::string for_terminal(std::string_view text, bool lines = true);

// Writes for_terminal(text) to standard error in one write, in place of the line that is open. Where standard
// error is full or closed the words are lost: no work ends for their sake.
void say_text(const std::string& text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(fmt::format(format, std::forward<Values>(values)...));
}

// Opens a line of the terminal, or writes over the one that is open; what is said next takes its place.
// `shown` is for_terminal already, and may be coloured.
void say_over_shown(const std::string& shown);

// Clears the line that is open. A program calls it at its end, and before another one speaks.
void close_line();

// Writes for_terminal(text) to standard output: the result that a program was asked for. Throws MachineError
// where it cannot be written. An error of text that is still buffered shows in flush_shown.
void show_text(const std::string& text);

template <class... Values>
void show(fmt::format_string<Values...> format, Values&&... values) {
  show_text(fmt::format(format, std::forward<Values>(values)...));
}

// Throws MachineError where standard output could not be written. It is called at the end of main.
void flush_shown();

// Opens /dev/null in place of each standard stream that is closed. Else the next file that is opened takes
// its place, and messages go into it. Standard output can then not be written. It is called at the start of
// main.
void open_standard_streams();

}  // namespace vitrail
