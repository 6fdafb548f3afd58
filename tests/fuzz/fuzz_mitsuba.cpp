// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/mitsuba.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] { return read_mitsuba(fuzz::write("scene.xml", data, size)).scene; });
}
