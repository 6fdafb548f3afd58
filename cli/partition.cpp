// SPDX-License-Identifier: Apache-2.0
#include "partitioner/partition.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iterator>

#include "cli/diagnostics_report.h"
#include "cli/main_guard.h"
#include "cli/mesh_options.h"
#include "cli/partition_report.h"
#include "cli/progress_line.h"
#include "cli/sizes.h"
#include "cli/within_memory.h"
#include "importers/import.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/meshes/edit_meshes.h"

namespace vitrail {
namespace {

struct Arguments {
  std::filesystem::path input, output, stats, profile;
  std::string domain_bytes, memory;
  bool strict = false, quiet = false;
  MeshOptions meshes;
  PartitionOptions options{.durable = true};
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
  app.add_flag("--no-sync{false}", a.options.durable, "do not wait until the bundle is on the disk");
  app.add_option("--threads", a.options.threads, "threads; default: all cores")->check(CLI::Range(1, 4096));
  app.add_option("--stats", a.stats, "write statistics as JSON");
  app.add_option("--profile", a.profile,
                 "where the rays of an earlier render of this scene went (`render --profile`): cut for them");
  declare_mesh_options(app, a.meshes);
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
  Watch(bool visible, Stage& stage) : line_(visible), stage_(stage) {}

  void operator()(double fraction, const char* what) {
    if (stop_signalled) throw MachineError("interrupted; nothing is left of the bundle");
    stage_.what = what;
    if (fraction < 1)
      line_.show(fraction, what);
    else
      line_.clear();
  }

 private:
  ProgressLine line_;
  Stage& stage_;
};

void interpret(Arguments& a) {
  if (!a.domain_bytes.empty()) {
    a.options.domain_bytes = parse_bytes(a.domain_bytes);
    if (a.options.domain_bytes == 0) throw UsageError("--domain-bytes has to be more than 0");
  }
  if (!a.profile.empty()) a.options.profile = read_ray_profile(a.profile);
  a.options.memory_bytes = a.memory.empty() ? default_memory_bytes() : parse_bytes(a.memory);
}

int run(Arguments& a, Stage& stage) {
  const std::uint64_t kept_bytes =
      a.options.domains_at_once > 0 ? 0 : mesh_bytes_within(a.options.memory_bytes);
  const bool visible = !a.quiet && ::isatty(STDERR_FILENO);
  Watch reading(visible, stage);
  tbb::task_arena arena(a.options.threads > 0 ? a.options.threads : tbb::task_arena::automatic);
  ImportedScene imported = arena.execute([&] {
    return import_scene(a.input, MeshMemory(kept_bytes), [&](double fraction) {
      stage.fraction = fraction;
      reading(std::min(fraction, 0.99), "reading the scene");
    });
  });
  stage = {"preparing the scene", 0, to_string(ledger_of(imported.scene))};
  Diagnostics diagnostics = std::move(imported.diagnostics);
  std::ranges::copy(appearance_of(imported.scene, {}).diagnostics, std::back_inserter(diagnostics));
  fmt::print(stderr, "{}", summarise(diagnostics));
  if (a.strict) require_exact(diagnostics);
  const MeshResources resources{kept_bytes, a.options.memory_bytes, a.options.threads};
  fmt::print(stderr, "{}", summarise(apply_mesh_options(a.meshes, imported.scene, resources)));
  catch_signals();
  Watch watch(visible, stage);
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
  return run_guarded(app, argc, argv, [&] {
    interpret(arguments);
    Stage stage{"reading the scene"};
    return within_memory(arguments.options.memory_bytes, stage, [&] { return run(arguments, stage); });
  });
}
