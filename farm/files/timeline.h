// SPDX-License-Identifier: Apache-2.0
// A Timeline records what the threads of a rank did when, for `render --trace`. It keeps the last events of
// each kind, in memory whose bound is known from the start.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vitrail {

class Timeline {
 public:
  using Clock = std::chrono::steady_clock;
  // The comment of a kind lists the values of its events. All but the last are spans of a thread's time,
  // which do not overlap.
  enum class Kind : std::uint8_t {
    generate,  // a task of new rays: how many
    trace,     // a batch: domain, rays
    idle,      // a worker without work
    load,      // domain, bytes that are mapped for it
    send,      // a message: rank, bytes, rays
    receive,   // the same
    write,     // a checkpoint, or the film
    counters   // a moment: rays that wait to be traced, and to be sent, domains and bytes in memory
  };
  static constexpr std::size_t kinds = 8;
  static constexpr std::size_t most_values = 4;
  using Values = std::array<std::int64_t, most_values>;
  struct Event {
    std::int64_t begin_ns = 0, end_ns = 0;  // of Clock
    std::int64_t thread = 0;                // 0: the one that moves rays; then workers, then loaders
    Values values{};
    bool operator==(const Event&) const = default;
  };

  // It holds so many events of this rank. Ranks have fewer the more there are, since one file holds all.
  explicit Timeline(std::size_t most_events);
  static std::size_t most_events(int ranks);
  static std::uint64_t most_bytes(int ranks);  // until all are gathered

  void add(Kind kind, int thread, Clock::time_point begin, Clock::time_point end, const Values& values = {});
  // Returns the events, ascending by their ends.
  std::vector<Event> events(Kind kind) const;
  std::uint64_t left_out(Kind kind) const;  // that were before these

 private:
  struct Ring {
    std::vector<Event> events;
    std::size_t most = 0;
    std::uint64_t added = 0;
  };
  std::array<Ring, kinds> rings_;
};

}  // namespace vitrail
