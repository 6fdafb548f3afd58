// SPDX-License-Identifier: Apache-2.0
// A volume as the density of a medium and as signed distances of a surface.
#include "importers/mitsuba/read/mitsuba.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  fuzz::write("grid.vol", data, size);
  static const std::filesystem::path scene = fuzz::write("scene.xml", R"(<scene version="3.0.0">
      <shape type="sdfgrid"><string name="filename" value="grid.vol"/></shape>
      <shape type="sphere"><bsdf type="null"/><medium type="heterogeneous" name="interior">
        <volume type="gridvolume" name="sigma_t"><string name="filename" value="grid.vol"/></volume>
      </medium></shape></scene>)");
  return fuzz::run([&] { fuzz::check(read_mitsuba(scene).scene); });
}
