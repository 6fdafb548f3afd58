// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/pbrt.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] { return read_pbrt(fuzz::write("scene.pbrt", data, size)).scene; });
}
