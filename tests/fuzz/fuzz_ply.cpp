// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/ply.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    Scene scene;
    Diagnostics diagnostics;
    scene.meshes.push_back(read_ply(fuzz::write("mesh.ply", data, size), &diagnostics));
    return scene;
  });
}
