// SPDX-License-Identifier: Apache-2.0
#include "farm/progress.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace vitrail {

Progress::Progress(ProgressMode mode, std::uint64_t items, std::uint64_t items_before)
    : mode_(mode),
      items_(static_cast<double>(items)),
      items_before_(static_cast<double>(items_before)),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

void Progress::show(const RoundSums& sums) {
  if (mode_ == ProgressMode::none) return;
  const auto now = std::chrono::steady_clock::now();
  const auto interval =
      mode_ == ProgressMode::bar ? std::chrono::milliseconds(100) : std::chrono::milliseconds(1000);
  if (now - last_ < interval) return;
  last_ = now;
  print(sums, std::chrono::duration<double>(now - start_).count());
}

void Progress::print(const RoundSums& sums, double elapsed_s) {
  const double done = items_ > 0 ? static_cast<double>(sums.items_done) / items_ : 1;
  const double here = static_cast<double>(sums.items_done) - items_before_;
  const double left_s = here > 0 ? elapsed_s * (items_ - static_cast<double>(sums.items_done)) / here : 0;
  const double rate = elapsed_s > 0 ? static_cast<double>(sums.rays_traced) / elapsed_s : 0;
  if (mode_ == ProgressMode::json) {
    fmt::print(
        stderr,
        "{{\"progress\":{:.6f},\"elapsed_s\":{:.3f},\"remaining_s\":{:.3f},\"rays\":{},\"rays_waiting\":{},"
        "\"domain_loads\":{}}}\n",
        done, elapsed_s, left_s, sums.rays_traced, sums.born - sums.died, sums.domain_loads);
    return;
  }
  constexpr int width = 32;
  const int filled = static_cast<int>(done * width);
  fmt::print(stderr, "\r\033[Krender [{}{}] {:5.1f} %  {:.2f} Mray/s  {} left",
             std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(width - filled), ' '), 100 * done, rate * 1e-6,
             left_s < 90 ? fmt::format("{:.0f} s", left_s) : fmt::format("{:.0f} min", left_s / 60));
  std::fflush(stderr);
  line_open_ = true;
}

void Progress::finish() {
  if (line_open_) fmt::print(stderr, "\r\033[K");
  line_open_ = false;
}

}  // namespace vitrail
