// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>

#include "tests/conformance/formats/feature_cases.h"
#include "tests/images/ptex_bytes.h"
#include "tests/laws/scattering/table_cases.h"

namespace vitrail::test {

void write_case_files(const std::filesystem::path& folder) {
  write_opened_files(folder);
  laws::write(laws::fourier_table([](Vector3d, Vector3d in) { return std::abs(in.z); }, 2, 1),
              folder / "fourier.bsdf");
  laws::write(laws::adaptive_table({.facets = make_microfacets(.3, .3), .resolution = 4, .incidences = 2}),
              folder / "measured.bsdf");
  std::ofstream(folder / "a.ptx", std::ios::binary)
      << ptex_bytes(PtexType::uint8, 3, {{0, 0, "abc"}, {0, 0, "def"}});
}

}  // namespace vitrail::test
