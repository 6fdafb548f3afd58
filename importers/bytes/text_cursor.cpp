// SPDX-License-Identifier: Apache-2.0
#include "importers/bytes/text_cursor.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "scene/system/say.h"

namespace vitrail {

namespace {

// Microsoft's C library before 2015: "-1.#IND", "1.#QNAN0", "1.#INF00".
bool is_not_finite(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  if (!word.starts_with("1.#")) return false;
  word.remove_prefix(3);
  const std::string_view kind = word.substr(0, word.find_last_not_of("0123456789") + 1);
  return kind == "IND" || kind == "QNAN" || kind == "SNAN" || kind == "INF";
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string shown;
  while (!text.empty() && shown.size() < longest) {
    const std::size_t size = utf8_size(text);
    const char c = text.front();
    if (size > 1) {
      shown += text.substr(0, size);
    } else if (c == '\t') {
      shown += ' ';
    } else {
      shown += size == 0 || static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    }
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return text.empty() ? shown : shown + "…";
}

const char* after_byte_order_mark(const char* begin, const char* end) {
  return std::string_view(begin, static_cast<std::size_t>(end - begin)).starts_with("\xef\xbb\xbf")
             ? begin + 3
             : begin;
}

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
    } else if (continuation()) {
      join_lines();
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
  while (!at_separator()) ++at_;
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
  if (const char* const stop = plain_decimal(at_, end_, value)) {
    at_ = stop;
    if (at_separator()) return value;
    at_ = begin;
  }
  const char* const digits = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
  const auto [stop, error] = fast_float::from_chars(digits, end_, value);
  at_ = stop;
  // Numbers too small for a double are zero; those too large have become infinite.
  if (error == std::errc::invalid_argument || !at_separator()) {
    at_ = begin;
    const std::string_view found = word();
    if (is_not_finite(found)) return std::numeric_limits<double>::quiet_NaN();
    fail(found.empty() ? fmt::format("{} is missing", what)
                       : fmt::format("{} is not a number: '{}'", what, printable(found)),
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
    const std::string found = printable(word());
    fail(found.empty() ? fmt::format("{} is missing", what)
                       : fmt::format("{} is not a whole number of 64 bits: '{}'", what, found),
         begin);
  }
  at_ = stop;
  return value;
}

SourceLocation TextCursor::location(const char* position) const {
  return {std::string(file_), line_, static_cast<int>(position - line_begin_) + 1};
}

void TextCursor::fail(const std::string& message, const char* position) const {
  constexpr std::ptrdiff_t before = 60, after = 60;  // what of a long line is shown
  const char* const begin = position - line_begin_ > before ? position - before : line_begin_;
  const char* stop = position;
  while (stop != end_ && *stop != '\n' && *stop != '\r' && stop - position < after) ++stop;
  throw Error(message, location(position), printable({begin, stop}, before + after));
}

}  // namespace vitrail
