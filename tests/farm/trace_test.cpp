// SPDX-License-Identifier: Apache-2.0
// render --trace: what each thread of each rank did when.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/background.h"
#include "tests/support/partitioned_box.h"

namespace vitrail::test::trace_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Json = nlohmann::json;

class Trace : public PartitionedBox {
 protected:
  Trace() : PartitionedBox(16) {}
  // Domains come and go.
  std::string arguments(const std::string& more) const {
    return fmt::format(" '{}' -o '{}' --stats '{}' --crop 0,48,0,48 --threads 2 --domain-memory 1 --quiet {}",
                       path("box.vit"), path("a.film"), path("stats.json"), more);
  }
  std::string traced(const std::string& more) const {
    return arguments(fmt::format("--trace '{}' {}", path("trace.json"), more));
  }
  Json trace() const { return read_json(path("trace.json")); }
};

std::vector<Json> of_category(const Json& trace, const std::string& category) {
  std::vector<Json> found;
  for (const Json& e : trace["traceEvents"])
    if (e.value("cat", "") == category) found.push_back(e);
  return found;
}

std::int64_t sum(const std::vector<Json>& events, const char* value) {
  std::int64_t all = 0;
  for (const Json& e : events) all += e["args"][value].get<std::int64_t>();
  return all;
}

// Nothing lies before the job's start or, but for ranks that end later than the first, after its end; and a
// thread does one thing at a time.
void expect_in_order(const Json& trace, double wall_s) {
  const double most_us = 1e6 * (wall_s + 1);
  std::map<std::pair<int, int>, std::vector<std::pair<double, double>>> spans;
  for (const Json& e : trace["traceEvents"])
    if (e["ph"] == "X")
      spans[{e["pid"], e["tid"]}].emplace_back(e["ts"], e["ts"].get<double>() + e["dur"].get<double>());
  EXPECT_FALSE(spans.empty());
  for (auto& [thread, of_thread] : spans) {
    std::ranges::sort(of_thread);
    EXPECT_GE(of_thread.front().first, 0);
    EXPECT_LE(of_thread.back().second, most_us);
    for (std::size_t i = 1; i < of_thread.size(); ++i)
      EXPECT_GE(of_thread[i].first, of_thread[i - 1].second - 1e-3)
          << "rank " << thread.first << ", thread " << thread.second;
  }
}

TEST_F(Trace, OfTwoRanksAgreesWithTheStatistics) {
  const CommandResult made = run(mpi_vitrail("render", 2) + traced("--spp 8 --checkpoint-every .2"));
  ASSERT_EQ(made.status, 0) << made.output;
  const Json all = trace(), stats = read_json(path("stats.json"));
  expect_in_order(all, stats["wall_s"]);
  const std::vector<Json> loads = of_category(all, "load"), sends = of_category(all, "send"),
                          receives = of_category(all, "receive"), batches = of_category(all, "trace");
  EXPECT_EQ(loads.size(), stats["domain_loads"]);
  EXPECT_GT(stats["evictions"], 0);
  EXPECT_EQ(sum(of_category(all, "generate"), "rays"), stats["rays_camera"]);
  EXPECT_EQ(sends.size(), stats["messages"]);
  EXPECT_EQ(receives.size(), sends.size());
  EXPECT_EQ(sum(sends, "bytes"), stats["forwarded_bytes"]);
  EXPECT_EQ(sum(receives, "bytes"), stats["forwarded_bytes"]);
  EXPECT_EQ(sum(sends, "rays"), stats["forwarded_rays"]);
  EXPECT_EQ(sum(receives, "rays"), stats["forwarded_rays"]);
  for (const auto* some : {&loads, &sends, &receives, &batches}) {
    std::set<int> ranks;
    for (const Json& e : *some) ranks.insert(e["pid"].get<int>());
    EXPECT_EQ(ranks, (std::set{0, 1}));
  }
  for (const Json& e : sends) EXPECT_EQ(e["args"]["to"], 1 - e["pid"].get<int>());
  for (const Json& e : receives) EXPECT_EQ(e["args"]["from"], 1 - e["pid"].get<int>());
  double loaded_s = 0;
  for (const Json& e : loads) loaded_s += 1e-6 * e["dur"].get<double>();
  EXPECT_NEAR(loaded_s, stats["load_s"].get<double>(), 1e-3);
  EXPECT_FALSE(of_category(all, "idle").empty());
  EXPECT_FALSE(of_category(all, "write").empty());
  for (const char* rank : {"rank 0", "rank 1"})
    for (const Json& left_out : all["otherData"][rank]["left_out"]) EXPECT_EQ(left_out, 0);
}

TEST_F(Trace, AgreesOnCheckpoints) {
  const CommandResult made =
      run(vitrail("render") +
          fmt::format(" '{}' -o '{}' --stats '{}' --trace '{}' --crop 0,48,0,48 --spp 128 "
                      "--threads 1 --checkpoint-every .05 --quiet",
                      path("box.vit"), path("a.film"), path("stats.json"), path("trace.json")));
  ASSERT_EQ(made.status, 0) << made.output;
  const Json stats = read_json(path("stats.json"));
  const std::vector<Json> writes = of_category(trace(), "write");
  EXPECT_GT(stats["checkpoints"], 1);
  ASSERT_EQ(writes.size(), stats["checkpoints"].get<std::size_t>() + 1) << "the last is the film's";
  double written_s = 0, longest_s = 0;
  for (std::size_t i = 0; i + 1 < writes.size(); ++i) {
    const double s = 1e-6 * writes[i]["dur"].get<double>();
    written_s += s, longest_s = std::max(longest_s, s);
  }
  EXPECT_GE(stats["checkpoint_s"], written_s);
  EXPECT_GE(stats["longest_checkpoint_s"], longest_s);
  EXPECT_LT(stats["longest_checkpoint_s"], stats["checkpoint_s"]);
  EXPECT_LT(stats["checkpoint_s"], stats["wall_s"]);
}

TEST_F(Trace, OfARenderThatEndsEarlyIsWritten) {
  ASSERT_EQ(run(vitrail("render") + traced("--time 1 --spp 100000")).status, 0);
  expect_in_order(trace(), read_json(path("stats.json"))["wall_s"]);
  EXPECT_FALSE(of_category(trace(), "trace").empty());
  fs::remove(path("trace.json"));
  Background job(mpi_vitrail("render", 2) + traced("--spp 100000 --checkpoint-every .1"));
  while (job.running() && !fs::exists(path("a.film.partial"))) std::this_thread::sleep_for(5ms);
  for (const pid_t rank : job.ranks()) ::kill(rank, SIGTERM);
  EXPECT_EQ(job.wait(), 128 + SIGTERM);
  EXPECT_FALSE(of_category(trace(), "trace").empty());
}

TEST_F(Trace, WhereNothingTakesItTheFilmIsWrittenAllTheSame) {
  fs::create_directory(path("gone"));
  Background job(mpi_vitrail("render", 2) +
                 arguments(fmt::format("--trace '{}' --spp 100000 --time 2", path("gone/trace.json"))));
  while (job.running() && !fs::exists(path("a.film.lock"))) std::this_thread::sleep_for(5ms);
  ASSERT_TRUE(job.running());
  fs::remove(path("gone"));
  EXPECT_EQ(job.wait(), 4);
  EXPECT_TRUE(fs::exists(path("a.film")));
  EXPECT_TRUE(fs::exists(path("stats.json")));
}

}  // namespace
}  // namespace vitrail::test::trace_test
