// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  const std::filesystem::path file = fuzz::write("mesh.ply", data, size);
  return fuzz::run([&] {
    for (const PlyAttributes wanted : {PlyAttributes::read, PlyAttributes::look}) {
      Scene scene;
      Diagnostics diagnostics;
      scene.meshes.push_back(read_ply(file, &diagnostics, wanted));
      fuzz::check(scene);
    }
  });
}
