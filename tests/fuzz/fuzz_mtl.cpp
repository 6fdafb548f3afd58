// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/obj.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  fuzz::write("scene.mtl", data, size);
  const std::string faces =
      "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n";
  return fuzz::run([&] {
    return read_obj(
               fuzz::write("scene.obj", reinterpret_cast<const std::uint8_t*>(faces.data()), faces.size()))
        .scene;
  });
}
