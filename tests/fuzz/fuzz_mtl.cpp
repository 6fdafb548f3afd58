// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  static const std::filesystem::path faces = fuzz::write(
      "scene.obj", "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n");
  fuzz::write("scene.mtl", data, size);
  return fuzz::run([&] { fuzz::check(read_obj(faces).scene); });
}
