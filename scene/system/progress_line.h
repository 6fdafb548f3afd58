// SPDX-License-Identifier: Apache-2.0
// Shows on standard error how far a program is: it is the one printer of all verbs.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace vitrail {

enum class ProgressManner { silent, line, lines };

// Returns `silent` if `quiet`, `line` on a terminal, whose line is kept up to date, else `lines`, printed now
// and then.
ProgressManner progress_manner(bool quiet);

// Returns a duration as "8.5 s", "12 s", "4 min" or "2 h 5 min".
std::string duration_in_words(double s);

// It is what is shown at a moment. `details` are in the order of their weight; those that have no room are
// left out.
struct ProgressNews {
  double fraction = 0;  // in [0, 1]
  std::string what;     // "reading the scene"
  double left_s = -1;   // below 0: not known
  std::vector<std::string> details;
};

// Returns "render 43 % 12 s left [###### ] 2.1 Mray/s", of no more than `columns` − 1 columns: in the last
// one some terminals begin the next line.
std::string line_of(const ProgressNews& news, int columns, bool colored);

// It shows one line ten times a second at most, or `lines`: after 2 s, 4, 8 … and then every minute. Messages
// that are printed in between take the line's place (say.h).
class ProgressLine {
 public:
  explicit ProgressLine(ProgressManner manner);
  bool is_due() const;
  void show(const ProgressNews& news);
  // Shows the same, with the time left estimated from what was done since the beginning.
  void show(double fraction, const char* what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  ProgressManner manner_;
  Clock::time_point start_, due_;
};

}  // namespace vitrail
