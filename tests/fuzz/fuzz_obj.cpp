// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] { fuzz::check(read_obj(fuzz::write("scene.obj", data, size)).scene); });
}
