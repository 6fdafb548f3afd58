// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "importers/pbrt/lens_file.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    const pbrt::ThinLens lens = pbrt::read_lens(fuzz::write("lens.dat", data, size), 0);
    fuzz::require(std::isfinite(lens.focal_length) && std::isfinite(lens.principal_gap) &&
                  std::isfinite(lens.pupil_radius) && std::isfinite(pbrt::image_distance(lens, 1000)));
  });
}
