// SPDX-License-Identifier: Apache-2.0
#include "partitioner/partition.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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
  std::filesystem::path input, output, stats;
  std::string domain_bytes;
  bool strict = false, quiet = false;
  PartitionOptions options;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("input", a.input, "scene file")->required();
  app.add_option("-o,--output", a.output, "bundle to write (NAME.vit)")->required();
  auto* domains =
      app.add_option("--domains", a.options.domains, "number of sub-domains")->check(CLI::Range(1, 999'999));
  app.add_flag("--require-everything", a.options.everything,
               "as if the scene required all that there is: to measure what the analysis saves");
  app.add_flag("--flatten", a.options.flatten, "copy what instances place instead of keeping them");
  app.add_option("--domain-bytes", a.domain_bytes, "size of a sub-domain, e.g. 64M (the default)")
      ->excludes(domains);
  app.add_option("--threads", a.options.threads, "threads; default: all cores")->check(CLI::Range(1, 4096));
  app.add_option("--stats", a.stats, "write statistics as JSON");
  app.add_flag("--strict", a.strict, "fail if anything in the scene is not imported exactly");
  app.add_flag("--quiet", a.quiet, "no progress and no summary");
}

void show_progress(double fraction, const char* what) {
  fmt::print(stderr, "\r{:3.0f} % {:<30}{}", 100 * fraction, what, fraction >= 1 ? "\n" : "");
  std::fflush(stderr);
}

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
                                    {"wall_s", s.wall_s},
                                    {"cpu_s", s.cpu_s},
                                    {"peak_rss_bytes", s.peak_rss_bytes}};
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
  if (s.objects > 0) fmt::print("  {} instances of {} objects are kept\n", s.instances, s.objects);
  fmt::print("  {:.2f} s, {:.2f} s of processor time, at most {} of memory\n", s.wall_s, s.cpu_s,
             format_bytes(s.peak_rss_bytes));
}

int run(Arguments& a) {
  if (!a.domain_bytes.empty()) {
    a.options.domain_bytes = parse_bytes(a.domain_bytes);
    if (a.options.domain_bytes == 0) throw UsageError("--domain-bytes has to be more than 0");
  }
  const ImportedScene imported = import_scene(a.input);
  Diagnostics diagnostics = imported.diagnostics;
  std::ranges::copy(appearance_of(imported.scene, {}).diagnostics, std::back_inserter(diagnostics));
  fmt::print(stderr, "{}", summarise(diagnostics));
  if (a.strict) require_exact(diagnostics);
  std::function<void(double, const char*)> progress;
  if (!a.quiet && ::isatty(STDERR_FILENO)) progress = show_progress;
  const PartitionStats stats = partition(imported.scene, a.output, a.options, progress);
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
