// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/ending_time.h"

#include <algorithm>

namespace vitrail {

using Clock = std::chrono::steady_clock;

Clock::time_point limit_start(const RenderOptions& options, Clock::time_point tracing) {
  const std::chrono::duration<double> half(options.resources.time_limit_s / 2);
  return std::max(options.resources.start, tracing - std::chrono::duration_cast<Clock::duration>(half));
}

double ending_time_s(const RenderOptions& options, std::uint64_t film_bytes, int ranks, double write_s,
                     double gather_s) {
  // Measured, see docs/why/adaptive.md: sums are hashed, checked and freed; of another rank's they are added.
  constexpr double own_s_per_byte = 1.5e-9, gather_s_per_byte = 2e-9;
  const auto bytes = static_cast<double>(film_bytes);
  const double gathering_s = gather_s > 0 ? gather_s : ranks > 1 ? gather_s_per_byte * bytes : 0;
  const AfterFilm& then = options.resources.after_film;
  return std::min(options.resources.time_limit_s / 2,
                  gathering_s + write_s + then.s + (own_s_per_byte + then.s_per_byte) * bytes);
}

}  // namespace vitrail
