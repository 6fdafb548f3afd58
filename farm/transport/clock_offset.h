// SPDX-License-Identifier: Apache-2.0
// It finds how far the clocks of two hosts are apart, by meetings that nobody leaves before all have come: so
// each came, by a true clock, before the other left (bounds as Cristian's, 1989, of one message and its
// answer).
#pragma once

#include <cstdint>
#include <span>

namespace vitrail {

struct Meeting {
  std::int64_t came_ns = 0, left_ns = 0;  // of one's own clock
};

struct ClockOffset {
  std::int64_t ns = 0;        // own clock minus the other's
  std::int64_t error_ns = 0;  // at most
};

// Returns the offset by the same meetings, at least one, seen by both. It is 0 where that is possible: ranks
// of one host have one clock.
ClockOffset clock_offset(std::span<const Meeting> own, std::span<const Meeting> others);

}  // namespace vitrail
