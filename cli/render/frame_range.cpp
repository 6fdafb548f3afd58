// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

class RangeReader {
 public:
  RangeReader(std::string_view text, std::size_t count) : text_(text), count_(count), taken_(count) {}

  std::vector<std::size_t> read() {
    do read_part();
    while (take(','));
    if (at_ < text_.size()) refuse(at_, "a comma has to follow");
    return numbers_;
  }

 private:
  // "7", "1-30" or "1-100x2".
  void read_part() {
    const std::size_t first = frame_number();
    std::size_t last = first, step = 1;
    if (take('-')) {
      const std::size_t place = at_;
      if ((last = frame_number()) < first)
        refuse(place, fmt::format("{} comes before {}: give the lesser first", last, first));
      if (take('x')) step = number("a step");
    }
    for (std::size_t n = first; n <= last; n += std::min(step, count_)) {
      if (!taken_[n - 1]) numbers_.push_back(n);
      taken_[n - 1] = true;
    }
  }

  std::size_t frame_number() {
    const std::size_t place = at_, n = number("the number of a frame");
    if (n > count_)
      refuse(place, fmt::format("there is no frame {}, as the list has {} frame{}", n, count_,
                                count_ == 1 ? "" : "s"));
    return n;
  }

  std::size_t number(const char* what) {
    std::size_t n = 0;
    const auto [end, failed] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), n);
    const bool is_none = end == text_.data() + at_;
    if (is_none || failed == std::errc::invalid_argument || (failed == std::errc() && n == 0))
      refuse(at_, fmt::format("{} has to follow, from 1 on", what));
    at_ = static_cast<std::size_t>(end - text_.data());
    return failed == std::errc() ? n : std::string::npos;
  }

  bool take(char c) {
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  [[noreturn]] void refuse(std::size_t place, const std::string& what) const {
    throw UsageError(
        fmt::format("--range {}: at character {}, \"{}\": {} (7, 1-30,47 and 1-100x2 are ranges)", text_,
                    place + 1, text_.substr(place), what));
  }

  std::string_view text_;
  std::size_t count_, at_ = 0;
  std::vector<bool> taken_;
  std::vector<std::size_t> numbers_;
};

}  // namespace

std::vector<std::size_t> parse_frame_range(const std::string& text, std::size_t count) {
  return RangeReader(text, count).read();
}

}  // namespace vitrail
