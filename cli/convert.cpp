// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cli/conversion_report.h"
#include "cli/diagnostics_report.h"
#include "cli/import_options.h"
#include "cli/main_guard.h"
#include "cli/mesh_options.h"
#include "cli/quadric_counts.h"
#include "importers/export.h"
#include "importers/import.h"
#include "partitioner/meshes/edit_meshes.h"
#include "scene/input_files.h"
#include "scene/output_place.h"

namespace vitrail {
namespace {

struct Arguments {
  std::filesystem::path input, output, report;
  bool strict = false, quiet = false;
  ImportArguments imports;
  MeshOptions meshes;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("input", a.input, "scene file: .pbrt, .xml, .obj, .ply")->required();
  app.add_option("output,-o,--output", a.output, "scene file: .pbrt (v4), .xml (Mitsuba 3), .pov, .obj, .ply")
      ->required();
  app.add_option("--report", a.report, "write what became of each item as JSON");
  declare_import_options(app, a.imports);
  declare_mesh_options(app, a.meshes);
  app.add_flag("--strict", a.strict, "exit with status 3 if anything is not exact");
  app.add_flag("--quiet", a.quiet, "say nothing but what is wrong");
}

void require_outputs(const Arguments& a) {
  for (const std::filesystem::path& file : {a.output, a.report})
    if (!file.empty()) require_place(file);
  std::error_code none;
  if (a.output == a.report || std::filesystem::equivalent(a.output, a.report, none))
    throw UsageError("the report would be written over the scene: " + a.report.string());
}

// Files that the scene speaks of are its own, whether the conversion opens them or not.
void note_referenced_files(const Scene& scene) {
  const auto note = [](const auto& record) {
    if constexpr (requires { record.filename; }) note_input(record.filename);
  };
  for (const Texture& texture : scene.textures) std::visit(note, texture.model);
  for (const Material& material : scene.materials) std::visit(note, material.model);
  for (const Light& light : scene.lights) std::visit(note, light.model);
}

// With --strict nothing is written where the input is not read exactly already.
int run(const Arguments& a) {
  require_export_format(a.output);
  note_input(a.input);
  require_outputs(a);
  ImportedScene imported = import_scene(a.input, MeshMemory{}, {}, import_options(a.imports));
  note_referenced_files(imported.scene);
  require_outputs(a);  // other than all that was read
  Diagnostics& diagnostics = imported.diagnostics;
  const bool refused = a.strict && !diagnostics.empty();
  const std::string quadrics = quadric_counts(imported.scene);
  Diagnostics edits;  // as asked for
  if (!refused) {
    edits = apply_mesh_options(a.meshes, imported.scene, MeshResources{});
    std::ranges::move(export_scene(imported.scene, a.output), std::back_inserter(diagnostics));
  }
  const bool exact = diagnostics.empty();
  std::ranges::move(edits, std::back_inserter(diagnostics));
  const std::vector<ConversionItem> items = conversion_items(imported.scene, diagnostics);
  if (!a.report.empty()) write_conversion_report(a.report, a.input, a.output, quadrics, items);
  if (!a.quiet) {
    fmt::print(stderr, "{}", summarise(diagnostics));
    const ConversionCounts counts = count(items);
    fmt::print("{}: {} items exact, {} approximated, {} dropped\n",
               refused ? "not written" : a.output.string(), counts.exact, counts.approximated,
               counts.dropped);
  }
  if (a.strict && !exact) require_exact(diagnostics);
  return exit_done;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("converts a scene from one format to another, and says what is not exact", "vitrail convert");
  Arguments arguments;
  declare(app, arguments);
  return run_guarded(app, argc, argv, [&] { return run(arguments); });
}
