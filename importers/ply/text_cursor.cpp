// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/text_cursor.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>

namespace vitrail {

namespace {

// What of a line is shown to the user.
std::string printable(const char* begin, const char* end) {
  constexpr std::ptrdiff_t longest = 100;
  std::string text(begin, begin + std::min(end - begin, longest));
  for (char& c : text) {
    if (c == '\t') c = ' ';
    if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '?';
  }
  return text;
}

}  // namespace

void TextCursor::break_line() {
  const bool two = *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n';
  at_ += two ? 2 : 1;
  line_begin_ = at_;
  ++line_;
}

void TextCursor::skip_blanks() {
  while (at_ != end_) {
    if (blank()) {
      ++at_;
    } else if (continuations_ && *at_ == '\\' && at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r')) {
      ++at_;
      break_line();
    } else {
      return;
    }
  }
}

bool TextCursor::at_line_end() {
  skip_blanks();
  return at_ == end_ || line_break();
}

bool TextCursor::skip_to_text() {
  while (at_line_end()) {
    if (at_ == end_) return false;
    break_line();
  }
  return true;
}

void TextCursor::skip_line() {
  while (at_ != end_ && !line_break()) ++at_;
  if (at_ != end_) break_line();
}

std::string_view TextCursor::word() {
  skip_blanks();
  const char* const begin = at_;
  while (at_ != end_ && !blank() && !line_break()) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view TextCursor::rest_of_line() {
  skip_blanks();
  const char* const begin = at_;
  while (at_ != end_ && !line_break()) ++at_;
  const std::string_view text(begin, static_cast<std::size_t>(at_ - begin));
  return text.substr(0, text.find_last_not_of(" \t\v\f") + 1);
}

double TextCursor::number(const char* what) {
  skip_blanks();
  const char* const begin = at_;
  double value = 0;
  const char* const digits = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
  const auto [stop, error] = fast_float::from_chars(digits, end_, value);
  at_ = stop;
  // Numbers too small for a double are zero; those too large have become infinite.
  if (error == std::errc::invalid_argument || (at_ != end_ && !blank() && !line_break())) {
    at_ = begin;
    const std::string found(word());
    fail(found.empty() ? fmt::format("{} is missing", what) : fmt::format("{} is not a number: '{}'", what, found),
         begin);
  }
  return value;
}

bool TextCursor::accept(char c) {
  if (at_ == end_ || *at_ != c) return false;
  ++at_;
  return true;
}

std::int64_t TextCursor::integer(const char* what) {
  skip_blanks();
  const char* const digits = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(digits, end_, value);
  if (error != std::errc{}) {
    const char* const begin = at_;
    const std::string found(word());
    fail(found.empty() ? fmt::format("{} is missing", what)
                       : fmt::format("{} is not a whole number of 64 bits: '{}'", what, found),
         begin);
  }
  at_ = stop;
  return value;
}

SourceLocation TextCursor::location(const char* position) const {
  return {file_, line_, static_cast<int>(position - line_begin_) + 1};
}

void TextCursor::fail(std::string message, const char* position) const {
  const char* line_end = line_begin_;
  while (line_end != end_ && *line_end != '\n' && *line_end != '\r') ++line_end;
  throw Error(std::move(message), location(position), printable(line_begin_, line_end));
}

}  // namespace vitrail
