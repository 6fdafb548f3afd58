// SPDX-License-Identifier: Apache-2.0
#include "farm/conclude/gather_timeline.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <thread>

#include "farm/files/trace_events.h"
#include "farm/transport/agreement.h"
#include "farm/transport/list_to_root.h"

namespace vitrail {

namespace {

std::int64_t in_ns(Timeline::Clock::time_point t) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(t.time_since_epoch()).count();
}

using Meetings = std::array<Meeting, 32>;

Meetings meet(Transport& transport) {
  Meetings all;
  for (Meeting& m : all) {
    m.came_ns = in_ns(Timeline::Clock::now());
    transport.start_round({}, {});
    while (!transport.finish_round()) {
      transport.goes_on();
      std::this_thread::yield();
    }
    m.left_ns = in_ns(Timeline::Clock::now());
  }
  return all;
}

ClockOffset offset_to_root(Transport& transport) {
  const Meetings mine = meet(transport);
  auto words = std::bit_cast<std::array<std::uint64_t, sizeof(Meetings) / sizeof(std::uint64_t)>>(mine);
  transport.broadcast_from_root(std::span<std::uint64_t>(words));
  return clock_offset(mine, std::bit_cast<Meetings>(words));
}

// What goes before the events as they travel.
struct Header {
  std::array<char, 64> host{};  // ends with a zero
  ClockOffset clock;
  std::int64_t workers = 0;
  std::array<std::uint64_t, Timeline::kinds> events{}, left_out{};
};

template <class Record>
using Words = std::array<std::int64_t, sizeof(Record) / sizeof(std::int64_t)>;

template <class Record>
void append(std::vector<std::int64_t>& list, const Record& record) {
  const auto words = std::bit_cast<Words<Record>>(record);
  list.insert(list.end(), words.begin(), words.end());
}

template <class Record>
Record take(const std::int64_t*& at) {
  Words<Record> words;
  std::copy_n(at, words.size(), words.begin());
  at += words.size();
  return std::bit_cast<Record>(words);
}

std::vector<std::int64_t> to_list(const Timeline& timeline, ClockOffset clock, int workers) {
  Header header{.clock = clock, .workers = workers};
  ::gethostname(header.host.data(), header.host.size() - 1);
  std::uint64_t events = 0;
  for (std::size_t k = 0; k < Timeline::kinds; ++k) {
    const auto kind = static_cast<Timeline::Kind>(k);
    events += header.events[k] = timeline.events(kind).size();
    header.left_out[k] = timeline.left_out(kind);
  }
  std::vector<std::int64_t> list;
  list.reserve((sizeof(Header) + events * sizeof(Timeline::Event)) / sizeof(std::int64_t));
  append(list, header);
  for (std::size_t k = 0; k < Timeline::kinds; ++k)
    for (const Timeline::Event& e : timeline.events(static_cast<Timeline::Kind>(k))) append(list, e);
  return list;
}

RankTimeline from_list(const std::vector<std::int64_t>& list) {
  const std::int64_t* at = list.data();
  const auto header = take<Header>(at);
  RankTimeline t{header.host.data(), header.clock, static_cast<int>(header.workers), {}, header.left_out};
  for (std::size_t k = 0; k < Timeline::kinds; ++k) {
    t.events[k].reserve(header.events[k]);
    for (std::uint64_t i = 0; i < header.events[k]; ++i) t.events[k].push_back(take<Timeline::Event>(at));
  }
  return t;
}

}  // namespace

void write_timelines(Transport& transport, const Timeline& mine, int workers,
                     Timeline::Clock::time_point origin, const std::filesystem::path& file) {
  const ClockOffset clock = offset_to_root(transport);
  std::optional<TraceFile> out;
  std::exception_ptr failure;  // told when all is gathered: the others wait for rank 0 until then
  const auto on_root = [&](const auto& step) {
    if (transport.rank() != 0 || failure) return;
    try {
      step();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  on_root([&] { out.emplace(file, in_ns(origin)); });
  for (int rank = 0; rank < transport.size(); ++rank) {
    std::vector<std::int64_t> list;
    if (rank == transport.rank()) list = to_list(mine, clock, workers);
    list = list_to_root(transport, rank, std::move(list));
    on_root([&] { out->add(rank, from_list(list)); });
  }
  on_root([&] { out->commit(); });
  agree(transport, [&] {
    if (failure) std::rethrow_exception(failure);
  });
}

}  // namespace vitrail
