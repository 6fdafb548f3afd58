// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/povray.h"

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"

namespace vitrail {

ImportedScene read_povray(const std::filesystem::path& file, MeshMemory memory,
                          const ImportOptions& options) {
  const pov::Limits limits{options.program, options.include_limit};
  pov::Reader reader(file, pov::search_of(file, options.include_folders), limits);
  reader.replace_missing = options.replace_missing;
  reader.for_export = options.for_export;
  for (const auto& [name, value] : options.definitions) reader.define(name, value);
  const pov::World world = pov::read_world(reader);
  ImportedScene imported;
  imported.scene = pov::SceneMaker(reader, world, memory).make();
  imported.diagnostics = reader.notes.take();
  return imported;
}

}  // namespace vitrail
