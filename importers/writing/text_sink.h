// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <span>
#include <string>

#include "scene/system/atomic_file.h"

namespace vitrail {

// It takes formatted text, which goes to a file, if there is one, whenever a piece of it is full.
class TextSink {
 public:
  explicit TextSink(AtomicFile* file = nullptr) : file_(file) {}

  // `form` is a FMT_COMPILE string: numbers have the fewest digits that give them back.
  template <class Form, class... Values>
  void put(const Form& form, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), form, values...);
    constexpr std::size_t piece = 1 << 20;
    if (file_ && text_.size() > piece) flush();
  }
  void flush() {
    file_->write(std::as_bytes(std::span(text_.data(), text_.size())));
    text_.clear();
  }
  std::string text() const { return fmt::to_string(text_); }

 private:
  AtomicFile* file_;
  fmt::memory_buffer text_;
};

}  // namespace vitrail
