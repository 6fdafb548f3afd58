// SPDX-License-Identifier: Apache-2.0
#include "scene/system/progress_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/system/say.h"
#include "scene/system/terminal.h"

namespace vitrail {

namespace {

using namespace std::chrono_literals;

constexpr auto of_the_line = 100ms, first_of_lines = 2000ms, last_of_lines = 60000ms;

// Continuation bytes of UTF-8 take no column.
std::size_t columns_in(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string bar(double fraction, std::size_t width, bool colored) {
  const auto filled = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(width));
  const std::string done(filled, '#'), left(width - filled, ' ');
  return colored ? fmt::format("[\033[32m{}\033[0m{}]", done, left) : fmt::format("[{}{}]", done, left);
}

}  // namespace

ProgressManner progress_manner(bool quiet) {
  return quiet ? ProgressManner::silent : on_terminal() ? ProgressManner::line : ProgressManner::lines;
}

std::string duration_in_words(double s) {
  if (s < 10) return fmt::format("{:.1f} s", s);
  if (s < 90) return fmt::format("{:.0f} s", s);
  const auto minutes = static_cast<long>(s / 60 + 0.5);
  return minutes < 90 ? fmt::format("{} min", minutes)
                      : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string line_of(const ProgressNews& news, int columns, bool colored) {
  constexpr std::size_t gap = 2, shortest = 10, longest = 34;  // of the bar, with its brackets
  const auto room = static_cast<std::size_t>(std::max(columns - 1, 1));
  const std::string percent = fmt::format("{:3.0f} %", 100 * news.fraction);
  std::string text;
  std::size_t used = 0;
  const auto add = [&](const std::string& part) {
    const std::size_t more = columns_in(part) + (used > 0 ? gap : 0);
    if (used + more > room) return false;
    if (used > 0) text.append(gap, ' ');
    text += part, used += more;
    return true;
  };
  if (columns_in(news.what) + gap + columns_in(percent) <= room) add(for_terminal(news.what, false));
  add(percent);
  if (news.left_s >= 0) add(duration_in_words(news.left_s) + " left");
  if (used + gap + shortest <= room) {
    const std::size_t width = std::min(longest, room - used - gap);
    text += std::string(gap, ' ') + bar(news.fraction, width - 2, colored);
    used += gap + width;
  }
  for (const std::string& detail : news.details) add(detail);
  return text;
}

ProgressLine::ProgressLine(ProgressManner manner)
    : manner_(manner),
      start_(Clock::now()),
      due_(start_ + (manner == ProgressManner::line ? of_the_line : first_of_lines)) {}

bool ProgressLine::is_due() const { return manner_ != ProgressManner::silent && Clock::now() >= due_; }

void ProgressLine::show(const ProgressNews& news) {
  if (!is_due()) return;
  const auto now = Clock::now();
  if (manner_ == ProgressManner::line) {
    due_ = now + of_the_line;
    return say_over_shown(line_of(news, terminal_columns(), has_color()));
  }
  due_ = now + std::clamp<Clock::duration>(now - start_, first_of_lines, last_of_lines);
  std::string text = fmt::format("vitrail: {} {:.0f} %", news.what, 100 * news.fraction);
  if (news.left_s >= 0) text += fmt::format(", {} left", duration_in_words(news.left_s));
  for (const std::string& detail : news.details) text += ", " + detail;
  say("{}\n", text);
}

void ProgressLine::show(double fraction, const char* what) {
  if (!is_due()) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  show({fraction, what, fraction > 0.02 ? elapsed_s * (1 - fraction) / fraction : -1, {}});
}

void ProgressLine::clear() {
  if (manner_ == ProgressManner::line) close_line();
}

}  // namespace vitrail
