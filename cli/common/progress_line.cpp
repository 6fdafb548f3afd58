// SPDX-License-Identifier: Apache-2.0
#include "cli/common/progress_line.h"
#include "scene/system/say.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace vitrail {

ProgressLine::ProgressLine(bool visible) : visible_(visible), start_(Clock::now()), shown_(start_) {}

void ProgressLine::show(double fraction, const char* what) {
  const auto now = Clock::now();
  if (!visible_ || now - shown_ < std::chrono::milliseconds(100)) return;
  shown_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      fraction > 0.02 ? fmt::format("  {:.0f} s left", elapsed_s * (1 - fraction) / fraction) : "";
  say_over("{:3.0f} % {}{}", 100 * fraction, what, left);
}

void ProgressLine::clear() {
  if (!visible_ || shown_ == start_) return;
  say_over("");
}

}  // namespace vitrail
