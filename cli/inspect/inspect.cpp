// SPDX-License-Identifier: Apache-2.0
#include "cli/inspect/inspect.h"

#include <fmt/format.h>

#include "bundle/packs.h"
#include "cli/common/import_arguments.h"
#include "cli/common/input_kind.h"
#include "cli/common/main_guard.h"
#include "cli/common/memory_budget.h"
#include "cli/common/own_threads.h"
#include "cli/common/sizes.h"
#include "scene/system/input_files.h"
#include "scene/system/say.h"
#include "scene/system/within_memory.h"

namespace vitrail {
namespace {

bool begins_with(const std::filesystem::path& file, std::string_view magic) {
  std::string head(magic.size(), '\0');
  open_regular(file).read(head.data(), static_cast<std::streamsize>(head.size()));
  return head == magic;
}

Report inspect(const std::filesystem::path& file, const ImportOptions& options) {
  if (!std::filesystem::exists(file)) throw Error("no such file", {file.string()});
  if (std::filesystem::is_directory(file)) return inspect_bundle(file);
  if (is_pack(file) && begins_with(file, "VITRDOM\n")) return inspect_pack(file);
  if (file.extension() == ".dom" || begins_with(file, "VITRDOM\n")) return inspect_domain({file});
  if (file.extension() == ".tex" || begins_with(file, "VITRTEX\n")) return inspect_texture(file);
  // A checkpoint is a film too.
  if (file.extension() == ".film" || file.extension() == ".partial" || file.extension() == ".work")
    return inspect_film(file);
  require_input(file, {InputKind::scene, InputKind::bundle, InputKind::film});
  return inspect_scene(file, options);
}

int status_of(const Report& report, bool strict) {
  const auto holds = [&](const char* key) { return report.contains(key) && !report[key].empty(); };
  const bool inexact = holds("not_exact") || holds("not_rendered_exactly");
  return report.contains("problems") || (strict && inexact) ? exit_bad_input : exit_done;
}

std::string as_json(const Report& report) {
  return report.dump(1, ' ', false, Report::error_handler_t::replace) + "\n";
}

// Of the scene, with which its own files begin.
std::filesystem::path folder_of(const std::filesystem::path& file) {
  return std::filesystem::is_directory(file) ? std::filesystem::path() : file.parent_path();
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("prints the contents of a scene, a bundle, one of its files or a film, and verifies them",
               "vitrail inspect");
  std::filesystem::path file;
  ImportArguments imports;
  bool json = false, quiet = false, strict = false;
  std::string memory;
  app.add_option("file", file,
                 "scene file, bundle (NAME.vit), sub-domain or object (.dom), texture (.tex) or film (.film)")
      ->required();
  declare_import_options(app, imports);
  app.add_flag("--json", json, "print JSON, as docs/reference/inspect.md lists it");
  declare_memory(app, memory);
  app.add_flag("--strict", strict, "exit with 3 if a part of the scene is not read or rendered exactly");
  app.add_flag("--quiet", quiet, "print problems only; the exit status tells the result");
  return run_guarded(app, argc, argv, [&] {
    const auto body = [&] {
      const Report report = inspect(file, import_options(imports));
      if (!quiet) show("{}", json ? as_json(report) : to_text(report, folder_of(file)));
      return status_of(report, strict);
    };
    return within_memory(memory_budget(memory, true), {"inspecting"}, body, runs_a_task);
  });
}
