// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/pbrt.h"
#include "tests/conformance/formats/feature_cases.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  vitrail::test::write_opened_files(vitrail::fuzz::folder());
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] { fuzz::check(read_pbrt(fuzz::write("scene.pbrt", data, size)).scene); });
}
