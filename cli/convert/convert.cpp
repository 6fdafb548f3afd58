// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cli/common/diagnostics_report.h"
#include "cli/common/import_arguments.h"
#include "cli/common/input_kind.h"
#include "cli/common/main_guard.h"
#include "cli/common/memory_budget.h"
#include "cli/common/mesh_options.h"
#include "cli/common/own_output.h"
#include "cli/common/own_threads.h"
#include "cli/common/quadric_counts.h"
#include "cli/convert/check_conversion.h"
#include "cli/convert/conversion_report.h"
#include "cli/convert/convert_many.h"
#include "cli/convert/peer_check.h"
#include "cli/convert/report_page.h"
#include "importers/export.h"
#include "importers/import.h"
#include "importers/reading/back_to_back_faces.h"
#include "importers/writing/own_scene.h"
#include "importers/writing/packed_files.h"
#include "partitioner/meshes/edit_meshes.h"
#include "scene/system/input_files.h"
#include "scene/system/machine_limits.h"
#include "scene/system/output_place.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

namespace vitrail {
namespace {

struct Arguments {
  std::vector<std::filesystem::path> files;
  std::filesystem::path input, output, report;
  std::string format, check, peer, input_peer, memory;
  int at_once = 0;
  bool strict = false, quiet = false, again = false, pack = false, force = false;
  ImportArguments imports;
  MeshOptions meshes;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("files", a.files,
                 "a scene (.pbrt, .xml, .glb, .gltf, .obj, .ply, .stl, .fbx, .dae, .3ds, .pov) and the file "
                 "to write (.pbrt: "
                 "v4, .xml: Mitsuba 3, .pov, .glb, .gltf, .obj, .ply); with --to: scenes, and folders that "
                 "are searched for them")
      ->required();
  app.add_option("-o,--output", a.output, "the file to write; with --to: the folder for all files");
  app.add_option("--to", a.format,
                 "convert many scenes to this format, each with NAME.report.json beside it. Scenes that are "
                 "done already are skipped")
      ->check(CLI::IsMember({"pbrt", "xml", "pov", "glb", "gltf", "obj", "ply"}));
  app.add_option("-j,--jobs", a.at_once,
                 "with --to: scenes to convert at once; default: one a processor allowed")
      ->check(CLI::Range(1, 4096));
  app.add_flag("--again", a.again, "with --to: convert scenes again that are done already");
  app.add_flag("--check{ours}", a.check,
               "render the scene before and after, small, and exit with status 1 if they look different. "
               "--check=peer also asks the program of the format (Mitsuba, POV-Ray or pbrt)")
      ->check(CLI::IsMember({"ours", "peer"}));
  app.add_option("--peer", a.peer,
                 "of --check=peer: a Python with Mitsuba, or povray, or pbrt; default: the one on the path");
  app.add_option("--peer-of-input", a.input_peer,
                 "likewise, the program of the input's format; default: the one on the path, if it is there");
  app.add_option("--report", a.report,
                 "write a report with a line for each item: exact, approximated or dropped; as a page "
                 "(.html), else as JSON");
  app.add_flag(
      "--pack", a.pack,
      "copy the images, tables and volumes that the scene refers to beside the output, into OUT-files/");
  declare_import_options(app, a.imports);
  declare_mesh_options(app, a.meshes);
  declare_memory(app, a.memory);
  app.add_flag("--force", a.force, "replace a file that does not say that vitrail made it");
  app.add_flag("--strict", a.strict, "exit with status 3 if anything is not exact");
  app.add_flag("--quiet", a.quiet, "print problems only");
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

// The words of a command line for what else becomes of the scene, whoever renders it.
std::vector<std::string> reading_options(const Arguments& a) {
  std::vector<std::string> words = arguments_of(a.imports);
  std::ranges::move(arguments_of(a.meshes), std::back_inserter(words));
  return words;
}

bool passed(const nlohmann::ordered_json& check) { return check.is_null() || check.value("passed", true); }

// With --strict nothing is written where the input is not read exactly already.
int run(const Arguments& a) {
  require_export_format(a.output);
  if (!a.check.empty()) require_checkable(a.output);
  require_input(a.input, {InputKind::scene});
  note_input(a.input);
  require_outputs(a);
  ImportOptions options = import_options(a.imports);
  options.for_export = true;
  ImportedScene imported = import_scene(a.input, MeshMemory{}, {}, options);
  if (has_materials_by_side(a.output)) join_faces_back_to_back(imported);
  note_referenced_files(imported.scene);
  require_outputs(a);  // other than all that was read
  require_own(a.output, is_own_scene, a.force);
  require_own_texts({a.report}, a.force);
  Diagnostics& diagnostics = imported.diagnostics;
  const bool refused = a.strict && !diagnostics.empty();
  const std::string quadrics = quadric_counts(imported.scene);
  Diagnostics edits;  // as asked for
  if (!refused) {
    edits = apply_mesh_options(a.meshes, imported.scene, MeshResources{}, false);
    if (a.pack) pack_files(imported.scene, a.output);
    std::ranges::move(export_scene(imported.scene, a.output), std::back_inserter(diagnostics));
  }
  const bool exact = diagnostics.empty();
  std::ranges::move(edits, std::back_inserter(diagnostics));
  const std::vector<ConversionItem> items = conversion_items(imported.scene, diagnostics);
  nlohmann::ordered_json pictures, peer;
  if (!a.check.empty() && !refused)
    pictures = compare_pictures(a.input, reading_options(a), a.output, imported.scene.film);
  if (a.check == "peer" && !refused)
    peer = check_in_peer({a.input, a.output, reading_options(a), a.peer, a.input_peer}, imported.scene.film);
  if (a.report.extension() == ".html")
    write_report_page(a.report, a.input, a.output, {pictures, peer}, diagnostics, items);
  else if (!a.report.empty())
    write_conversion_report(a.report, a.input, a.output, quadrics, reading_options(a), {pictures, peer},
                            items);
  if (!a.quiet) {
    say("{}", summarise(diagnostics));
    const ConversionCounts counts = count(items);
    show("{}: {} items exact, {} approximated, {} dropped\n", refused ? "not written" : a.output.string(),
         counts.exact, counts.approximated, counts.dropped);
    if (!pictures.is_null()) show("{}\n", pictures_in_words(pictures));
    if (!peer.is_null()) show("{}\n", peer_in_words(peer));
  }
  if (a.strict && !exact) require_exact(diagnostics);
  return passed(pictures) && passed(peer) ? exit_done : exit_differs;
}

int run_many(const Arguments& a) {
  if (a.output.empty()) throw UsageError("--to needs the folder for all: -o FOLDER");
  if (!a.check.empty()) require_checkable("scene." + a.format);
  if (a.pack) throw UsageError("--pack takes one scene, not --to");
  if (!a.report.empty()) throw UsageError("--to gives every scene its report: leave --report out");
  std::vector<std::string> options = reading_options(a);
  if (a.force) options.push_back("--force");
  const int at_once = threads_for(a.at_once);
  const std::uint64_t bytes = memory_budget(a.memory, a.quiet) / static_cast<std::uint64_t>(at_once);
  ManyConversions many{a.files, a.output, a.format,     at_once,  bytes,   a.again,
                       a.check, a.peer,   a.input_peer, a.strict, a.quiet, options};
  return convert_many(many);
}

int run_one(Arguments a) {
  if (a.again || a.at_once != 0) throw UsageError("--again and --jobs belong to --to");
  const std::size_t most = a.output.empty() ? 2 : 1;
  if (a.files.size() > most)
    throw UsageError(fmt::format("'{}' is one argument too many; many scenes take --to FORMAT and -o FOLDER",
                                 a.files[most].string()));
  if (!(a.peer + a.input_peer).empty() && a.check != "peer")
    throw UsageError("--peer and --peer-of-input belong to --check=peer");
  if (a.output.empty() && a.files.size() == 1) throw UsageError("takes a scene and the file to write");
  if (a.output.empty()) a.output = a.files.back();
  a.input = a.files.front();
  return within_memory(
      memory_budget(a.memory, a.quiet), {"converting"}, [&] { return run(a); }, runs_a_task);
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("converts a scene from one format to another, and reports each loss", "vitrail convert");
  Arguments arguments;
  declare(app, arguments);
  return run_guarded(app, argc, argv,
                     [&] { return arguments.format.empty() ? run_one(arguments) : run_many(arguments); });
}
