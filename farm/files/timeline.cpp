// SPDX-License-Identifier: Apache-2.0
#include "farm/files/timeline.h"

#include <algorithm>

namespace vitrail {

namespace {

// Of the events, by kind: a flood of one leaves the others as they are.
constexpr std::array<std::size_t, Timeline::kinds> sixteenths{2, 5, 4, 1, 1, 1, 1, 1};

constexpr std::size_t of_a_rank = 1 << 17, of_a_job = 1 << 21, least = 1 << 11;

std::int64_t in_ns(Timeline::Clock::time_point t) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(t.time_since_epoch()).count();
}

}  // namespace

Timeline::Timeline(std::size_t most_events) {
  for (std::size_t k = 0; k < kinds; ++k) {
    rings_[k].most = std::max<std::size_t>(1, most_events / 16 * sixteenths[k]);
    rings_[k].events.reserve(rings_[k].most);
  }
}

std::size_t Timeline::most_events(int ranks) {
  return std::clamp(of_a_job / static_cast<std::size_t>(ranks), least, of_a_rank);
}

std::uint64_t Timeline::most_bytes(int ranks) {
  constexpr std::uint64_t copies = 3;      // itself, in order, as words
  constexpr std::uint64_t text = 2 << 20;  // of the file, as it is written
  return copies * most_events(ranks) * sizeof(Event) + text;
}

void Timeline::add(Kind kind, int thread, Clock::time_point begin, Clock::time_point end,
                   const Values& values) {
  Ring& ring = rings_[static_cast<std::size_t>(kind)];
  const Event event{in_ns(begin), in_ns(end), thread, values};
  if (ring.events.size() < ring.most)
    ring.events.push_back(event);
  else
    ring.events[ring.added % ring.most] = event;
  ++ring.added;
}

std::vector<Timeline::Event> Timeline::events(Kind kind) const {
  const Ring& ring = rings_[static_cast<std::size_t>(kind)];
  std::vector<Event> all = ring.events;
  if (ring.added > ring.most)
    std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(ring.added % ring.most), all.end());
  return all;
}

std::uint64_t Timeline::left_out(Kind kind) const {
  const Ring& ring = rings_[static_cast<std::size_t>(kind)];
  return ring.added - ring.events.size();
}

}  // namespace vitrail
