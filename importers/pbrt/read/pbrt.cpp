// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/pbrt.h"

#include "importers/pbrt/read/directives.h"
#include "importers/reading/default_view.h"

namespace vitrail {

namespace {

pbrt::Context context_of(const std::filesystem::path& file, MeshMemory memory,
                         std::function<void(double)> progress, const ImportOptions& options) {
  pbrt::Context context;
  context.replace_missing = options.replace_missing;
  context.all_media = options.all_media;
  context.mesh_memory = std::move(memory);
  context.progress = std::move(progress);
  if (context.mesh_memory.is_limited()) context.report.count_repeated();
  const pbrt::DetectedVersion detected = pbrt::detect_version(file);
  context.version = detected.version;
  context.version_is_certain = detected.certain;
  context.directory = file.parent_path();
  return context;
}

}  // namespace

ImportedScene read_pbrt(const std::filesystem::path& file, MeshMemory memory,
                        std::function<void(double)> progress, const ImportOptions& options) {
  pbrt::Context context = context_of(file, std::move(memory), std::move(progress), options);
  pbrt::TokenStream tokens(file, options.include_limit);
  pbrt::Interpreter interpreter(tokens, context);
  ImportedScene imported;
  imported.scene = interpreter.run();
  imported.diagnostics = context.report.take();
  if (!interpreter.had_world()) add_default_view(imported, file);
  return imported;
}

SkimmedScene skim_pbrt(const std::filesystem::path& file, std::function<void(double)> progress,
                       const ImportOptions& options) {
  pbrt::Context context = context_of(file, MeshMemory(0), std::move(progress), options);
  context.skim.emplace();
  pbrt::TokenStream tokens(file, options.include_limit);
  tokens.skip_lists();
  pbrt::Interpreter interpreter(tokens, context);
  SkimmedScene skimmed{.scene = interpreter.run(),
                       .grid_bytes = context.skim->grid_bytes,
                       .statement_bytes = context.skim->statement_bytes};
  sum_up_meshes(skimmed);
  return skimmed;
}

}  // namespace vitrail
