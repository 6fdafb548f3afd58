// SPDX-License-Identifier: Apache-2.0
// POV-Ray's scene language, and what its objects become. Loops are bounded sooner than for users.
#include "importers/povray/read/povray.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    const auto file = fuzz::write("scene.pov", data, size);
    pov::Limits limits;
    limits.tokens = 100'000;
    limits.written_bytes = 1 << 20;
    limits.open_calls = 200;
    limits.include_bytes = 1 << 20;
    pov::Reader reader(file, {{fuzz::folder()}}, limits);
    const pov::World world = pov::read_world(reader);
    MeshMemory memory;
    fuzz::check(pov::SceneMaker(reader, world, memory).make());
  });
}
