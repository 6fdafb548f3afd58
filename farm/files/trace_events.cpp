// SPDX-License-Identifier: Apache-2.0
#include "farm/files/trace_events.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>

#include "farm/scheduler/residency.h"

namespace vitrail {

namespace {

using Kind = Timeline::Kind;
using Json = nlohmann::ordered_json;

// By kind: the category, and what its values are called.
struct Look {
  const char* category;
  std::array<const char*, Timeline::most_values> values;
};
constexpr std::array<Look, Timeline::kinds> looks{{{"generate", {"rays"}},
                                                   {"trace", {"domain", "rays"}},
                                                   {"idle", {}},
                                                   {"load", {"domain", "bytes"}},
                                                   {"send", {"to", "bytes", "rays"}},
                                                   {"receive", {"from", "bytes", "rays"}},
                                                   {"write", {}},
                                                   {"counters", {}}}};

// Of a span, in µs with all digits.
std::string micros(std::int64_t ns) {
  return fmt::format("{}{}.{:03}", ns < 0 ? "-" : "", std::abs(ns) / 1000, std::abs(ns) % 1000);
}

void append_span(std::string& text, int rank, Kind kind, const Timeline::Event& e, std::int64_t shift_ns) {
  const Look& look = looks[static_cast<std::size_t>(kind)];
  const bool of_domain = kind == Kind::trace || kind == Kind::load;
  fmt::format_to(std::back_inserter(text),
                 R"(,{{"ph":"X","pid":{},"tid":{},"ts":{},"dur":{},"cat":"{}","name":"{}{}","args":{{)", rank,
                 e.thread, micros(e.begin_ns - shift_ns), micros(e.end_ns - e.begin_ns), look.category,
                 look.category, of_domain ? fmt::format(" {}", e.values[0]) : "");
  for (std::size_t i = 0; i < e.values.size() && look.values[i]; ++i)
    fmt::format_to(std::back_inserter(text), R"({}"{}":{})", i > 0 ? "," : "", look.values[i], e.values[i]);
  text += "}}\n";
}

void append_counters(std::string& text, int rank, const Timeline::Event& e, std::int64_t shift_ns) {
  const auto& [waiting, to_send, domains, bytes] = e.values;
  const auto append = [&](const char* name, const std::string& values) {
    fmt::format_to(std::back_inserter(text),
                   R"(,{{"ph":"C","pid":{},"ts":{},"name":"{}","args":{{{}}}}})"
                   "\n",
                   rank, micros(e.begin_ns - shift_ns), name, values);
  };
  append("rays", fmt::format(R"("waiting":{},"to send":{})", waiting, to_send));
  append("resident domains", fmt::format(R"("domains":{})", domains));
  append("resident bytes", fmt::format(R"("bytes":{})", bytes));
}

void append_name(std::string& text, const char* of, int rank, int thread, const std::string& name) {
  const Json event{{"ph", "M"}, {"pid", rank}, {"tid", thread}, {"name", of}, {"args", {{"name", name}}}};
  text += ',' + event.dump() + '\n';
}

void append_names(std::string& text, int rank, const RankTimeline& t) {
  const std::uint64_t left_out = std::accumulate(t.left_out.begin(), t.left_out.end(), std::uint64_t{0});
  append_name(text, "process_name", rank, 0,
              fmt::format("rank {} on {}{}", rank, t.host,
                          left_out > 0 ? fmt::format(", {} earlier events left out", left_out) : ""));
  append_name(text, "thread_name", rank, 0, "messages");
  for (int w = 1; w <= t.workers; ++w) append_name(text, "thread_name", rank, w, fmt::format("worker {}", w));
  for (int l = 1; l <= loaders_of_a_rank; ++l)
    append_name(text, "thread_name", rank, t.workers + l, fmt::format("loader {}", l));
}

Json about(const RankTimeline& t) {
  Json left_out;
  for (std::size_t k = 0; k < Timeline::kinds; ++k) left_out[looks[k].category] = t.left_out[k];
  return {{"host", t.host},
          {"clock_offset_ns", t.clock.ns},
          {"clock_error_ns", t.clock.error_ns},
          {"left_out", left_out}};
}

}  // namespace

TraceFile::TraceFile(const std::filesystem::path& file, std::int64_t origin_ns)
    : file_(file),
      origin_ns_(origin_ns),
      text_(R"({"displayTimeUnit":"ms","otherData":{"program":"vitrail"},"traceEvents":[)") {}

void TraceFile::write_out() {
  file_.write(std::as_bytes(std::span(text_)));
  text_.clear();
}

void TraceFile::add(int rank, const RankTimeline& t) {
  constexpr std::size_t worth_writing_bytes = 1 << 20;
  const std::int64_t shift_ns = origin_ns_ + t.clock.ns;
  const std::size_t begin = text_.size();
  append_names(text_, rank, t);
  if (about_ranks_.empty()) text_[begin] = ' ';  // nothing is before the first event
  for (std::size_t k = 0; k < Timeline::kinds; ++k)
    for (const Timeline::Event& e : t.events[k]) {
      const auto kind = static_cast<Kind>(k);
      if (kind == Kind::counters)
        append_counters(text_, rank, e, shift_ns);
      else
        append_span(text_, rank, kind, e, shift_ns);
      if (text_.size() > worth_writing_bytes) write_out();
    }
  about_ranks_ += fmt::format("{}\"rank {}\":{}", about_ranks_.empty() ? "" : ",\n", rank, about(t).dump());
}

void TraceFile::commit() {
  text_ += "],\n\"otherData\":{" + about_ranks_ + "}}\n";
  write_out();
  file_.commit();
}

}  // namespace vitrail
