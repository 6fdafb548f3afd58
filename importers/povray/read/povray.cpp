// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/povray.h"

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"

namespace vitrail {

ImportedScene read_povray(const std::filesystem::path& file, MeshMemory memory,
                          const ImportOptions& options) {
  pov::Limits limits;
  limits.include_bytes = options.include_limit;
  pov::Reader reader(file, pov::search_of(file, {}), limits);
  const pov::World world = pov::read_world(reader);
  ImportedScene imported;
  imported.scene = pov::SceneMaker(reader, world, memory).make();
  imported.diagnostics = reader.notes.take();
  return imported;
}

}  // namespace vitrail
