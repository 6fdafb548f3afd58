// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/table_files.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run(
      [&] { fuzz::require(!fault_of(read_fourier_table(fuzz::write("table.bsdf", data, size)))); });
}
