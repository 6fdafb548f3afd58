// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <malloc.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iterator>
#include <string_view>
#include <utility>

#include "bundle/checked_json.h"
#include "bundle/manifest_json.h"
#include "cli/common/bundle_origin.h"
#include "cli/common/diagnostics_report.h"
#include "cli/common/import_arguments.h"
#include "cli/common/input_kind.h"
#include "cli/common/layer_names.h"
#include "cli/common/main_guard.h"
#include "cli/common/memory_budget.h"
#include "cli/common/mesh_options.h"
#include "cli/common/own_output.h"
#include "cli/common/own_threads.h"
#include "cli/common/sizes.h"
#include "cli/common/switching_glazing.h"
#include "cli/partition/partition_arguments.h"
#include "cli/partition/partition_report.h"
#include "importers/import.h"
#include "importers/readers.h"
#include "importers/reading/back_to_back_faces.h"
#include "importers/reading/lamps_off.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/arena_threads.h"
#include "partitioner/caching/file_cache.h"
#include "partitioner/least_memory.h"
#include "partitioner/meshes/edit_meshes.h"
#include "scene/system/input_files.h"
#include "scene/system/memory_guard.h"
#include "scene/system/output_place.h"
#include "scene/system/progress_line.h"
#include "scene/system/resource_usage.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

namespace vitrail {
namespace {

std::atomic<int> stop_signal{0};

void on_signal(int number) { stop_signal = number; }

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM}) ::sigaction(number, &action, nullptr);
}

// Stops the work on a signal; on a terminal shows where it stands.
class Watch {
 public:
  Watch(ProgressManner manner, Stage& stage) : line_(manner), stage_(stage) {}

  void operator()(double fraction, const char* what) {
    if (stop_signal) throw Interrupted(stop_signal, "interrupted; nothing is left of the bundle");
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

std::uint64_t triangles_of(const Scene& scene) {
  const auto sum = [&](const std::vector<Shape>& shapes) {
    std::uint64_t triangles = 0;
    for (const Shape& shape : shapes) triangles += vitrail::triangles_of(scene.meshes[shape.mesh.value]);
    return triangles;
  };
  std::uint64_t triangles = sum(scene.shapes);
  for (const Instance& instance : scene.instances)
    triangles += sum(scene.prototypes[instance.prototype.value].shapes);
  return triangles;
}

// Some more than triangles may be of use, to see that the picture does not change; many more are a mistake.
void require_sense(const PartitionArguments& a, const Scene& scene) {
  constexpr std::uint64_t always = 4096, a_triangle = 4;
  const std::uint64_t triangles = triangles_of(scene);
  if (a.options.domains > std::max(always, a_triangle * triangles))
    throw UsageError(
        fmt::format("{} domains for {} triangles: most would be empty", a.options.domains, triangles));
}

// The same scene's bundle is replaced as a matter of course; another one may have taken hours. One without an
// origin is that of a job that was killed before it could say it.
void require_no_other(const PartitionArguments& a) {
  if (a.force || !std::filesystem::exists(a.output / "manifest.json")) return;
  const std::string scene = read_bundle_origin(a.output).scene;
  std::error_code gone;
  if (scene.empty() || scene == std::filesystem::absolute(a.input) ||
      std::filesystem::equivalent(scene, a.input, gone))
    return;
  throw Error(fmt::format("it is a bundle of {}; --force replaces it", scene), {a.output.string()});
}

void interpret(PartitionArguments& a) {
  if (!a.domain_bytes.empty()) {
    a.options.domain_bytes = parse_bytes(a.domain_bytes);
    if (a.options.domain_bytes == 0) throw UsageError("--domain-bytes has to be more than 0");
  }
  if (!a.pack.empty()) {
    a.options.pack_bytes = parse_bytes(a.pack);
    if (a.options.pack_bytes == 0) throw UsageError("--pack has to be more than 0");
  }
  require_input(a.input, {InputKind::scene});
  note_input(a.input);
  const std::filesystem::path bundle = a.output.has_filename() ? a.output : a.output.parent_path();
  require_folder_of(bundle);
  require_short_name(bundle);
  require_no_other(a);
  if (!a.stats.empty()) require_place(a.stats);
  require_own_texts({a.stats}, a.force);
  if (!a.profile.empty()) a.options.profile = read_ray_profile(a.profile);
  if (!a.aov.empty()) a.layers = parse_layers(a.aov);
  if (const auto folder = cache_folder(); a.cached && !folder.empty()) {
    a.options.cache = folder / "images";
    if (a.keeps_domains) a.options.bundles = folder / "bundles";
  }
  a.options.memory_bytes = memory_budget(a.memory, a.quiet || !a.summary);
}

ProgressManner manner_of(const PartitionArguments& a) {
  return a.progress == "bar"    ? ProgressManner::line
         : a.progress == "none" ? ProgressManner::silent
                                : progress_manner(a.quiet);
}

ImportedScene read(const PartitionArguments& a, std::uint64_t kept_bytes, Stage& stage) {
  Watch reading(manner_of(a), stage);
  stage = {.what = "reading the scene", .start_bytes = static_cast<double>(resident_bytes())};
  tbb::task_arena arena(arena_threads(a.options.threads));
  return arena.execute([&] {
    return read_scene_file(
        a.input, MeshMemory(kept_bytes),
        [&](double fraction) {
          stage.fraction = fraction;
          reading(std::min(fraction, 0.99), "reading the scene");
        },
        import_options(a.imports));
  });
}

// Throws MemoryNeeded with a budget that is enough to read the scene and for what follows, found by a reading
// without its long lists. Returns where the memory is too little for that as well.
void require_memory_to_read(const PartitionArguments& a, Stage& stage) {
  const Reader& reader = reader_of(a.input);
  if (!reader.skim) return;
  std::uint64_t needed = 0;
  const double read_then = stage.fraction;
  try {
    const LentReserve lent;
    const ImportOptions options = import_options(a.imports);
    const SkimmedScene skimmed = reader.skim({.file = a.input,
                                              .memory = MeshMemory{},
                                              .progress = [&](double fraction) { stage.fraction = fraction; },
                                              .options = options});
    const std::uint64_t records = ledger_of(skimmed.scene).all();
    const auto enough = [&](std::uint64_t more) {
      return std::max(budget_to_hold(records + more + skimmed.statement_bytes, a.options.memory_bytes),
                      least_memory(skimmed.scene, a.options, more + 2 * skimmed.grid_bytes));
    };
    needed = enough(0);
    if (skimmed.mesh_bytes > mesh_bytes_within(needed)) needed = enough(skimmed.sample_bytes);
  } catch (...) {  // the first reading's end is what counts
    stage.fraction = read_then;
    return;
  }
  throw MemoryNeeded(a.options.memory_bytes, needed, stage.what);
}

// With all meshes in their files where the memory is too little for some, and there is any left.
ImportedScene read_within_memory(const PartitionArguments& a, std::uint64_t kept_bytes, Stage& stage) {
  for (const std::uint64_t bytes : {kept_bytes, std::uint64_t{0}}) {
    try {
      return read(a, bytes, stage);
    } catch (...) {
      if (!memory_refusal().refused) throw;
      constexpr std::uint64_t least = 4 << 20;
      if (bytes == 0 || !memory_allows(least)) {
        require_memory_to_read(a, stage);
        throw;
      }
    }
    forget_refusal();
  }
  throw std::logic_error("a reading neither ends nor fails");
}

// The plan reckons with averages: where they are too low, with smaller parts.
PartitionStats divide(const Scene& scene, PartitionArguments& a, Stage& stage) {
  constexpr double least_share = 0.25;
  for (;; a.options.memory_share /= 2) {
    Watch watch(manner_of(a), stage);
    try {
      return partition(scene, a.output, a.options, std::ref(watch));
    } catch (const MemoryNeeded&) {
      throw;
    } catch (...) {
      const std::string_view at = stage.what;
      const bool is_dividing = at.starts_with("cutting") || at.starts_with("sorting");
      if (!memory_refusal().refused || !is_dividing || a.options.memory_share <= least_share) throw;
    }
    ::malloc_trim(0);
    forget_refusal();
  }
}

// The notes are gone after it: there may be very many.
void report(const PartitionArguments& a, ImportedScene& imported) {
  Diagnostics diagnostics = std::exchange(imported.diagnostics, {});
  std::ranges::copy(
      appearance_of(imported.scene, {}, {.cache = a.options.cache, .trust_integers = true}).diagnostics,
      std::back_inserter(diagnostics));
  if (!a.quiet) say("{}", summarise(diagnostics));
  if (a.strict) require_exact(diagnostics);
}

// A sky has more than three numbers: where the scene's file asks for them it does without.
void settle_rgb(const PartitionArguments& a, Scene& scene) {
  if (!a.rgb.empty()) scene.settings.rgb = rgb_method(a.rgb);
  const auto is_sky = [](const Light& l) { return std::holds_alternative<SkyLight>(l.model); };
  if (scene.settings.rgb != RgbMethod::bands || std::ranges::none_of(scene.lights, is_sky)) return;
  if (!a.rgb.empty())
    throw UsageError("--rgb bands: a sky's light has more than three numbers; give --rgb jakob-hanika");
  scene.settings.rgb = RgbMethod::jakob_hanika;
}

int write_bundle(PartitionArguments& a, std::uint64_t kept_bytes, ImportedScene& imported, Stage& stage) {
  stage = {.what = "preparing the scene", .held = to_string(ledger_of(imported.scene))};
  if (a.imports.lamps_are_off()) turn_off_lamps(imported);
  complete_scene(imported, import_options(a.imports));
  join_faces_back_to_back(imported);
  settle_rgb(a, imported.scene);
  report(a, imported);
  require_sense(a, imported.scene);
  if (a.layers) imported.scene.film.layers.bits = a.layers->bits;
  if (!a.quiet && a.summary && imported.scene.lights.empty() && imported.scene.area_lights.empty())
    say("vitrail: {} has no light: its picture is black; add a lamp, or give --sky LATITUDE,LONGITUDE,TIME\n",
        a.input.string());
  const MeshResources resources{kept_bytes, a.options.memory_bytes, a.options.threads};
  const Diagnostics edits = apply_mesh_options(a.meshes, imported.scene, resources, true);
  if (!a.quiet) say("{}", summarise(edits));
  a.options.glazings = switching_glazings(imported.scene);
  catch_signals();
  const PartitionStats stats = divide(imported.scene, a, stage);
  if (a.summary) write_bundle_origin(a.output, origin_of(a));
  if (!a.stats.empty()) write_stats(a.stats, stats);
  if (!a.quiet && a.summary) print_summary(stats, a.output);
  return exit_done;
}

int run(PartitionArguments& a, Stage& stage) {
  const std::uint64_t kept_bytes =
      a.options.domains_at_once > 0 ? 0 : mesh_bytes_within(a.options.memory_bytes);
  ImportedScene imported = read_within_memory(a, kept_bytes, stage);
  if (a.view_only) {
    const Scene& scene = imported.scene;
    write_checked_json(a.output, view_to_json({scene.camera, scene.camera_motion, scene.shutter,
                                               scene.film.width, scene.film.height}));
    return exit_done;
  }
  try {
    return write_bundle(a, kept_bytes, imported, stage);
  } catch (...) {
    if (memory_refusal().refused) stage.needed_bytes = least_memory(imported.scene, a.options);
    throw;
  }
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("cuts a scene into sub-domains that each fit into memory: a bundle", "vitrail partition");
  PartitionArguments arguments;
  declare(app, arguments);
  return end_with(run_guarded(app, argc, argv, [&] {
    interpret(arguments);
    Stage stage{"reading the scene"};
    return within_memory(
        arguments.options.memory_bytes, stage, [&] { return run(arguments, stage); }, runs_a_task);
  }));
}
