// SPDX-License-Identifier: Apache-2.0
// What a program says to its user.
#pragma once

#include <fmt/format.h>

#include <string>

namespace vitrail {

// One write to standard error. Where that is full or closed the words are lost: no work ends for their sake.
void say_text(const std::string& text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(fmt::format(format, std::forward<Values>(values)...));
}

// For the start of main: a stream that is closed becomes /dev/null. Else the next file that is opened takes
// its place, and what is said goes into it.
void open_standard_streams();

}  // namespace vitrail
