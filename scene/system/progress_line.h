// SPDX-License-Identifier: Apache-2.0
// How far a program is, on standard error: the one printer of all verbs.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace vitrail {

enum class ProgressManner { silent, line, lines };

// A line on a terminal, which is kept up to date; elsewhere lines now and then; nothing if `quiet`.
ProgressManner progress_manner(bool quiet);

// "12 s", "4 min", "2 h 5 min".
std::string duration_in_words(double s);

// What is told of a moment. `details` are in the order of their weight, those without room are left out.
struct ProgressNews {
  double fraction = 0;  // in [0, 1]
  std::string what;     // "reading the scene"
  double left_s = -1;   // below 0: not known
  std::vector<std::string> details;
};

// "render  43 %  12 s left  [######      ]  2.1 Mray/s", of no more than `columns` − 1 columns: in the last
// one some terminals begin the next line.
std::string line_of(const ProgressNews& news, int columns, bool colored);

// The line ten times a second at most, or lines: after 2 s, 4, 8 … and then every minute. What is said in
// between takes the line's place (say.h).
class ProgressLine {
 public:
  explicit ProgressLine(ProgressManner manner);
  bool is_due() const;
  void show(const ProgressNews& news);
  // The same, with the time left by what was done since the beginning.
  void show(double fraction, const char* what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  ProgressManner manner_;
  Clock::time_point start_, due_;
};

}  // namespace vitrail
