// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "importers/pbrt/read/lens_file.h"
#include "scene/models/lens_tracing.h"
#include "scene/models/paraxial_lens.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    const std::vector<LensSurface> surfaces = pbrt::read_lens(fuzz::write("lens.dat", data, size), 0);
    const ThinLens lens = thin_lens(surfaces);
    fuzz::require(std::isfinite(lens.focal_length) && std::isfinite(lens.principal_gap) &&
                  std::isfinite(lens.pupil_radius));
    if (const auto ray = through_lens(surfaces, {0, 0, -surfaces.back().thickness}, {0, 0}))
      fuzz::require(std::isfinite(ray->direction.x) && std::isfinite(ray->origin.z));
  });
}
