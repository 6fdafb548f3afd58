// SPDX-License-Identifier: Apache-2.0
// A TraceFile writes timelines as Chrome's trace events ("Trace Event Format", Google 2016), which Perfetto
// opens: a process a rank.
#pragma once

#include <string>

#include "farm/files/timeline.h"
#include "farm/transport/clock_offset.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

// It holds the events that one rank tells.
struct RankTimeline {
  std::string host;
  ClockOffset clock;  // to rank 0's
  int workers = 0;
  std::array<std::vector<Timeline::Event>, Timeline::kinds> events;
  std::array<std::uint64_t, Timeline::kinds> left_out{};
};

class TraceFile {
 public:
  // Its times are of rank 0's clock and count from `origin_ns` on.
  TraceFile(const std::filesystem::path& file, std::int64_t origin_ns);
  void add(int rank, const RankTimeline& timeline);  // each once
  void commit();

 private:
  void write_out();

  AtomicFile file_;
  std::int64_t origin_ns_;
  std::string text_, about_ranks_;  // that is not in the file yet
};

}  // namespace vitrail
