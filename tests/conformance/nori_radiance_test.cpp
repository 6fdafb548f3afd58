// SPDX-License-Identifier: Apache-2.0
// Nori's scalar tests: the radiance that one ray sees, against known values.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "importers/import.h"
#include "tests/conformance/corpus_render.h"
#include "tests/conformance/nori_scene.h"
#include "tests/support/command.h"
#include "tests/support/render.h"

namespace vitrail::test::nori_radiance_test {
namespace {

class NoriRadiance : public ::testing::TestWithParam<const char*> {};

TEST_P(NoriRadiance, IsSeen) {
  if (corpus().empty()) GTEST_SKIP() << "there is no corpus here; set VITRAIL_CORPUS";
  const TemporaryDirectory directory;
  int number = 0;
  for (const NoriScene& scene : read_nori(corpus() / GetParam())) {
    const std::filesystem::path file = directory / fmt::format("{}.xml", number);
    std::ofstream(file) << scene.mitsuba;
    const Rendered rendered = render(import_scene(file).scene, 1 << 15, 1, 7);
    const Brightness seen = brightness(rendered.film);
    const double off = std::abs(seen.mean - scene.reference);
    // 1e-5: the references have six decimals.
    conclude(off <= 4.5 * seen.standard_error + 1e-5 && off <= 0.01 * scene.reference,
             fmt::format("{}:{}", std::filesystem::path(GetParam()).stem().string(), number++),
             fmt::format("radiance {:.6f} ± {:.6f}, reference {:.6f}", seen.mean, seen.standard_error,
                         scene.reference));
  }
  EXPECT_GT(number, 0);
}

INSTANTIATE_TEST_SUITE_P(Corpus, NoriRadiance,
                         ::testing::Values("nori/pa4/tests/test-mesh.xml", "nori/pa5/tests/test-direct.xml"),
                         [](const auto& file) {
                           return case_name("nori_" + std::filesystem::path(file.param).stem().string());
                         });

}  // namespace
}  // namespace vitrail::test::nori_radiance_test
