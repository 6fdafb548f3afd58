// SPDX-License-Identifier: Apache-2.0
// What a program says to its user.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace vitrail {

// Bytes of the well-formed UTF-8 character that `text`, which is not empty, begins with (Unicode 15, table
// 3-7); 0 if there is none.
std::size_t utf8_size(std::string_view text);

// The text as a terminal may have it, whatever a scene calls its things: control characters, those that turn
// the direction of what follows, and bytes that are not UTF-8 are written out ("\u001b", "\xff"). `lines`:
// line feeds and tabs stay as they are.
std::string for_terminal(std::string_view text, bool lines = true);

// One write to standard error, in place of the line that is open, for_terminal. Where that is full or closed
// the words are lost: no work ends for their sake.
void say_text(const std::string& text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(fmt::format(format, std::forward<Values>(values)...));
}

// Opens a line of the terminal, or writes over the one that is open; what is said next takes its place.
// `shown` is for_terminal already, and may be coloured.
void say_over_shown(const std::string& shown);

// For the end of a program, and before another one speaks: the line that is open is gone.
void close_line();

// What a program was asked for, on standard output, for_terminal. Throws MachineError where it cannot be
// written; what is still on its way shows in flush_shown.
void show_text(const std::string& text);

template <class... Values>
void show(fmt::format_string<Values...> format, Values&&... values) {
  show_text(fmt::format(format, std::forward<Values>(values)...));
}

// For the end of main: throws MachineError where standard output could not be written.
void flush_shown();

// For the start of main: a stream that is closed becomes /dev/null. Else the next file that is opened takes
// its place, and what is said goes into it. Standard output can then not be written.
void open_standard_streams();

}  // namespace vitrail
