// SPDX-License-Identifier: Apache-2.0
#include "importers/stl/read/stl.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  const std::filesystem::path file = fuzz::write("mesh.stl", data, size);
  return fuzz::run([&] {
    Scene scene;
    scene.meshes.push_back(read_stl(file));
    fuzz::check(scene);
  });
}
