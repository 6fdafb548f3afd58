// SPDX-License-Identifier: Apache-2.0
// A product, or a system that may have itself as a pane.
#include "glazing/system_file.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  const std::filesystem::path file = fuzz::write("glazing.json", data, size);
  fuzz::run([&] { read_products(file); });
  return fuzz::run([&] { read_system({file.string()}); });
}
