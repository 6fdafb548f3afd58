// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/gltf.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  ImportOptions options;
  options.replace_missing = true;  // images are another reader's
  return fuzz::run(
      [&] { fuzz::check(read_gltf(fuzz::write("scene.gltf", data, size), MeshMemory{}, options).scene); });
}
