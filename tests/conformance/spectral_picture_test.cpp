// SPDX-License-Identifier: Apache-2.0
// Spectra of pixels against those of pbrt-v4, and law 1 for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/image_io.h"
#include "tests/conformance/corpus_render.h"
#include "tests/support/command.h"

namespace vitrail::test {
namespace {

class SpectralPicture : public ::testing::Test {
 protected:
  // Returns the hash of the film.
  std::string render(const std::string& name, const char* domains, const std::string& arguments) {
    const std::string bundle = (directory_ / (name + ".vit")).string(),
                      stats = (directory_ / "stats.json").string();
    const CommandResult made =
        run(fmt::format("{} '{}' -o '{}' --domains {} --quiet", vitrail("partition"),
                        (corpus() / "pbrt-v4/scenes/01_cornell_spectral.pbrt").string(), bundle, domains));
    EXPECT_EQ(made.status, 0) << made.output;
    const CommandResult done = run(fmt::format("{} '{}' -o '{}' --stats '{}' {}", vitrail("render"), bundle,
                                               (directory_ / (name + ".exr")).string(), stats, arguments));
    EXPECT_EQ(done.status, 0) << done.output;
    return read_json(stats)["film_hash"];
  }
  TemporaryDirectory directory_;
};

TEST_F(SpectralPicture, MatchesPbrtInEveryBin) {
  if (corpus().empty()) GTEST_SKIP() << "there is no corpus here; set VITRAIL_CORPUS";
  render("a", "4", "--spp 16");
  const Picture a = read_picture(directory_ / "a.exr"),
                b = read_picture(corpus() / "pbrt-v4/ref/01_cornell_spectral.exr");
  ASSERT_EQ(a.bins.count, 16);
  ASSERT_EQ(b.bins.count, 16);
  ASSERT_EQ(a.spectrum.values.size(), b.spectrum.values.size());
  std::string line;
  double worst = 0;
  for (int bin = 0; bin < 16; ++bin) {
    EXPECT_NEAR(a.bins.centre_nm(bin), b.bins.centre_nm(bin), 0.01);
    double sum_a = 0, sum_b = 0;
    for (std::size_t p = 0; p < b.rgb.pixels(); ++p) {
      if (b.rgb.values[3 * p] > 2) continue;  // the lamp, which would be most of the sum and of its noise
      const std::size_t i = 16 * p + static_cast<std::size_t>(bin);
      sum_a += static_cast<double>(a.spectrum.values[i]), sum_b += static_cast<double>(b.spectrum.values[i]);
    }
    if (sum_b == 0) {
      EXPECT_EQ(sum_a, 0) << bin;  // the light shines from 400 to 700 nm
      continue;
    }
    worst = std::max(worst, std::abs(sum_a / sum_b - 1));
    line += fmt::format(" {:.4f}", sum_a / sum_b);
  }
  conclude(worst < 0.01, "01_cornell_spectral", "mean ratios of the bins" + line);
}

TEST_F(SpectralPicture, IsOnePictureWhateverTheDomains) {
  if (corpus().empty()) GTEST_SKIP() << "there is no corpus here; set VITRAIL_CORPUS";
  const std::string crop = "--spp 4 --crop 64,192,64,192 ";
  const std::string one = render("one", "1", crop);
  EXPECT_EQ(render("many", "8", crop + "--threads 3"), one);
  EXPECT_EQ(render("few", "8", crop + "--domain-memory 1 --threads 2 --shuffle-delivery 5"), one);
}

}  // namespace
}  // namespace vitrail::test
