// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/mitsuba.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  fuzz::write("mesh.serialized", data, size);
  const std::string scene =
      "<scene version=\"3.0.0\"><shape type=\"serialized\"><string name=\"filename\" "
      "value=\"mesh.serialized\"/>"
      "<integer name=\"shape_index\" value=\"0\"/></shape></scene>";
  return fuzz::run([&] {
    return read_mitsuba(
               fuzz::write("scene.xml", reinterpret_cast<const std::uint8_t*>(scene.data()), scene.size()))
        .scene;
  });
}
