// SPDX-License-Identifier: Apache-2.0
// DrainTime expects how long the rays that are alive take to end, once no new ones begin, by the last time
// that was waited for.
#pragma once

#include <algorithm>
#include <cstdint>

namespace vitrail {

class DrainTime {
 public:
  void measured(double seconds, std::int64_t rays_alive) {
    seconds_ = seconds;
    rays_ = std::max<std::int64_t>(1, rays_alive);
    known_ = true;
  }
  bool known() const { return known_; }

  // Returns the time, which grows in proportion where more rays are alive: each may want a domain of its own.
  // It is 0 where nothing was measured.
  double expected_s(std::int64_t rays_alive) const {
    const double share = static_cast<double>(rays_alive) / static_cast<double>(rays_);
    return seconds_ * std::max(1.0, share);
  }

 private:
  bool known_ = false;
  double seconds_ = 0;
  std::int64_t rays_ = 1;
};

}  // namespace vitrail
