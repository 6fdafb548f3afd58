// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/pbrt.h"

#include "importers/pbrt/read/directives.h"
#include "importers/reading/default_view.h"

namespace vitrail {

ImportedScene read_pbrt(const std::filesystem::path& file, MeshMemory memory,
                        std::function<void(double)> progress, const ImportOptions& options) {
  pbrt::Context context;
  context.replace_missing = options.replace_missing;
  context.all_media = options.all_media;
  context.mesh_memory = std::move(memory);
  context.progress = std::move(progress);
  const pbrt::DetectedVersion detected = pbrt::detect_version(file);
  context.version = detected.version;
  context.version_is_certain = detected.certain;
  context.directory = file.parent_path();
  pbrt::TokenStream tokens(file, options.include_limit);
  pbrt::Interpreter interpreter(tokens, context);
  ImportedScene imported;
  imported.scene = interpreter.run();
  imported.diagnostics = context.report.take();
  if (!interpreter.had_world()) add_default_view(imported, file);
  return imported;
}

}  // namespace vitrail
