// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "importers/bytes/plain_decimal.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

// Returns a piece of input as it can be shown in a message: about `longest` bytes of it, as well-formed UTF-8
// (reports are JSON) without control characters.
std::string printable(std::string_view text, std::size_t longest = 40);

// Returns where the text begins behind the mark that some editors put before UTF-8.
const char* after_byte_order_mark(const char* begin, const char* end);

// Reads words and numbers of a text and knows where it is. Lines end with \n, \r\n or \r; a backslash before
// the end of a line joins it with the next one if `continuations` is set. It is cheap to copy. The text, of
// which `begin` starts a line, and the name outlive it.
class TextCursor {
 public:
  TextCursor(std::string_view file, const char* begin, const char* end, bool continuations = false,
             int line = 1)
      : file_(file), at_(begin), end_(end), line_begin_(begin), line_(line), continuations_(continuations) {}

  const char* at() const { return at_; }
  const char* end() const { return end_; }
  int line() const { return line_; }
  // Returns whether `c` comes next.
  bool sees(char c) const { return at_ != end_ && *at_ == c; }

  // Returns whether a word or a number may end here: at a blank, or where the line or the text ends.
  bool at_separator() const { return at_ == end_ || blank() || line_break() || continuation(); }
  // Skips blanks. Returns true if the line has ended there.
  bool at_line_end();
  // Skips blanks and ends of lines. Returns false at the end of the text.
  bool skip_to_text();
  void skip_line();

  // Returns the characters up to the next blank; empty at the end of the line.
  std::string_view word();
  // Returns the rest of the line without the blanks around it.
  std::string_view rest_of_line();
  // Returns a number that ends at a blank or the end of the line; anything else throws Error. `what` names it
  // in the message. "nan", "inf" and what Microsoft's libraries wrote for them ("-1.#IND") are numbers.
  double number(const char* what);
  // Reads the next number if it is a plain one (plain_decimal.h) behind spaces and line feeds; its place goes
  // to `begin`. Otherwise it returns false, and may have skipped blanks.
  bool next_plain_number(double& value, const char*& begin) {
    for (; at_ != end_ && (*at_ == ' ' || *at_ == '\n'); ++at_) {
      if (*at_ != '\n') continue;
      line_begin_ = at_ + 1;
      ++line_;
    }
    const char* const stop = plain_decimal(at_, end_, value);
    if (!stop || (stop != end_ && *stop != ' ' && *stop != '\n')) return false;
    begin = at_;
    at_ = stop;
    return true;
  }
  // Skips the end of a line, if a backslash stands before it and comes next.
  void join_lines() {
    while (at_ != end_ && continuation()) ++at_, break_line();
  }
  // Consumes `c` if it comes next.
  bool accept(char c);
  // Returns a decimal integer, which must fit; nothing is required to follow it.
  std::int64_t integer(const char* what);

  SourceLocation location() const { return location(at_); }
  // Returns the place of a position in the present line.
  SourceLocation location(const char* position) const;
  // Throws Error at a position in the present line, with the line as the excerpt.
  [[noreturn]] void fail(const std::string& message, const char* position) const;
  [[noreturn]] void fail(const std::string& message) const { fail(message, at_); }

 private:
  bool blank() const { return *at_ == ' ' || *at_ == '\t' || *at_ == '\v' || *at_ == '\f'; }
  bool line_break() const { return *at_ == '\n' || *at_ == '\r'; }
  bool continuation() const {
    return continuations_ && *at_ == '\\' && at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r');
  }
  void skip_blanks();
  void break_line();

  std::string_view file_;
  const char* at_;
  const char* end_;
  const char* line_begin_;
  int line_;
  bool continuations_;
};

}  // namespace vitrail
