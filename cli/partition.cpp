// SPDX-License-Identifier: Apache-2.0
#include "partitioner/partition.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/diagnostics_report.h"
#include "cli/main_guard.h"
#include "cli/sizes.h"
#include "importers/import.h"
#include "partitioner/appearance.h"
#include "scene/atomic_file.h"

namespace vitrail {
namespace {

struct Arguments {
  std::filesystem::path input, output, stats, profile;
  std::string domain_bytes, memory;
  bool strict = false, quiet = false;
  PartitionOptions options;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("input", a.input, "scene file")->required();
  app.add_option("-o,--output", a.output, "bundle to write (NAME.vit)")->required();
  auto* domains =
      app.add_option("--domains", a.options.domains, "number of sub-domains")->check(CLI::Range(1, 999'999));
  app.add_option("--domains-at-once", a.options.domains_at_once)->group("");
  app.add_flag("--require-everything", a.options.everything,
               "as if the scene required all that there is: to measure what the analysis saves");
  app.add_flag("--median-cuts", a.options.median,
               "halve the triangles at every cut: to measure what cuts by cost save");
  app.add_flag("--flatten", a.options.flatten, "copy what instances place instead of keeping them");
  app.add_option("--domain-bytes", a.domain_bytes, "size of a sub-domain, e.g. 64M (the default)")
      ->excludes(domains);
  app.add_option(
      "--memory", a.memory,
      "most memory to use, e.g. 512M; default: three quarters of the machine's. A larger scene goes to "
      "disk beside the bundle on its way");
  app.add_option("--threads", a.options.threads, "threads; default: all cores")->check(CLI::Range(1, 4096));
  app.add_option("--stats", a.stats, "write statistics as JSON");
  app.add_option("--profile", a.profile,
                 "where the rays of an earlier render of this scene went (`render --profile`): cut for them");
  app.add_flag("--strict", a.strict, "fail if anything in the scene is not imported exactly");
  app.add_flag("--quiet", a.quiet, "no progress and no summary");
}

std::atomic<bool> stop_signalled{false};

void on_signal(int) { stop_signalled = true; }

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM}) ::sigaction(number, &action, nullptr);
}

// Stops the work on a signal; on a terminal shows where it stands.
class Watch {
 public:
  explicit Watch(bool visible) : visible_(visible), start_(Clock::now()), shown_(start_) {}

  void operator()(double fraction, const char* what) {
    if (stop_signalled) throw MachineError("interrupted; nothing is left of the bundle");
    const auto now = Clock::now();
    if (!visible_ || (fraction < 1 && now - shown_ < std::chrono::milliseconds(100))) return;
    shown_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const bool known = fraction > 0.02 && fraction < 1;
    fmt::print(stderr, "\r\033[K{:3.0f} % {}{}{}", 100 * fraction, what,
               known ? fmt::format("  {:.0f} s left", elapsed_s * (1 - fraction) / fraction) : "",
               fraction >= 1 ? "\n" : "");
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  Clock::time_point start_, shown_;
};

void write_stats(const std::filesystem::path& file, const PartitionStats& s) {
  const nlohmann::ordered_json json{{"input_triangles", s.input_triangles},
                                    {"cut_triangles", s.cut_triangles},
                                    {"pieces", s.pieces},
                                    {"domains", s.domains},
                                    {"triangles_min", s.triangles_min},
                                    {"triangles_mean", s.triangles_mean},
                                    {"triangles_max", s.triangles_max},
                                    {"bundle_bytes", s.bundle_bytes},
                                    {"duplicates", s.duplicates},
                                    {"area_error", s.area_error},
                                    {"objects", s.objects},
                                    {"instances", s.instances},
                                    {"domain_bytes_max", s.domain_bytes_max},
                                    {"wall_s", s.wall_s},
                                    {"cpu_s", s.cpu_s},
                                    {"peak_rss_bytes", s.peak_rss_bytes},
                                    {"memory_budget_bytes", s.memory_budget_bytes},
                                    {"buckets", s.buckets},
                                    {"spill_bytes", s.spill_bytes},
                                    {"triangles_per_s", s.triangles_per_s}};
  const std::string text = json.dump(1) + "\n";
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

void print_summary(const PartitionStats& s, const std::filesystem::path& bundle) {
  fmt::print("{}: {} triangles in {} domains, {}\n", bundle.string(), s.input_triangles, s.domains,
             format_bytes(s.bundle_bytes));
  fmt::print("  a domain has {} to {} triangles, {:.0f} on average\n", s.triangles_min, s.triangles_max,
             s.triangles_mean);
  fmt::print("  {} triangles were cut into {} pieces; {} duplicates, area error {:.2g}\n", s.cut_triangles,
             s.pieces, s.duplicates, s.area_error);
  if (s.objects > 0)
    fmt::print("  {} instances of {} objects are kept; a domain takes at most {} with its objects\n",
               s.instances, s.objects, format_bytes(s.domain_bytes_max));
  fmt::print("  {:.2f} s, {:.2f} s of processor time, {:.2f} million triangles a second\n", s.wall_s, s.cpu_s,
             s.triangles_per_s * 1e-6);
  fmt::print("  at most {} of memory of {} allowed; {}\n", format_bytes(s.peak_rss_bytes),
             format_bytes(s.memory_budget_bytes),
             s.buckets > 1
                 ? fmt::format("in {} parts, {} on disk on the way", s.buckets, format_bytes(s.spill_bytes))
                 : "all triangles at once");
}

int run(Arguments& a) {
  if (!a.domain_bytes.empty()) {
    a.options.domain_bytes = parse_bytes(a.domain_bytes);
    if (a.options.domain_bytes == 0) throw UsageError("--domain-bytes has to be more than 0");
  }
  if (!a.profile.empty()) a.options.profile = read_ray_profile(a.profile);
  a.options.memory_bytes = a.memory.empty() ? default_memory_bytes() : parse_bytes(a.memory);
  const ImportedScene imported = import_scene(
      a.input, MeshMemory(a.options.domains_at_once > 0 ? 0 : mesh_bytes_within(a.options.memory_bytes)));
  Diagnostics diagnostics = imported.diagnostics;
  std::ranges::copy(appearance_of(imported.scene, {}).diagnostics, std::back_inserter(diagnostics));
  fmt::print(stderr, "{}", summarise(diagnostics));
  if (a.strict) require_exact(diagnostics);
  catch_signals();
  Watch watch(!a.quiet && ::isatty(STDERR_FILENO));
  const PartitionStats stats = partition(imported.scene, a.output, a.options, std::ref(watch));
  if (!a.stats.empty()) write_stats(a.stats, stats);
  if (!a.quiet) print_summary(stats, a.output);
  return exit_done;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("cuts a scene into sub-domains that each fit into memory: a bundle", "vitrail partition");
  Arguments arguments;
  declare(app, arguments);
  return run_guarded(app, argc, argv, [&] { return run(arguments); });
}
