// SPDX-License-Identifier: Apache-2.0
// Spectra of pixels against those of pbrt-v4, and law 1 for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/image_io.h"
#include "tests/conformance/corpus_render.h"
#include "tests/support/command.h"

namespace vitrail::test::spectral_picture_test {
namespace {

constexpr const char* scene_of_corpus = "pbrt-v4/scenes/01_cornell_spectral.pbrt";

class SpectralPicture : public ::testing::Test {
 protected:
  // Returns the hash of the film.
  std::string render(const std::string& name, const char* domains, const std::string& arguments) {
    const std::string bundle = (directory_ / (name + ".vit")).string(),
                      stats = (directory_ / "stats.json").string();
    if (!std::filesystem::exists(bundle)) {
      const CommandResult made = run(fmt::format("{} '{}' -o '{}' --domains {} --quiet", vitrail("partition"),
                                                 (corpus() / scene_of_corpus).string(), bundle, domains));
      EXPECT_EQ(made.status, 0) << made.output;
    }
    const CommandResult done =
        run(fmt::format("{} '{}' -o '{}' --force --stats '{}' {}", vitrail("render"), bundle,
                        (directory_ / (name + ".exr")).string(), stats, arguments));
    EXPECT_EQ(done.status, 0) << done.output;
    return read_json(stats)["film_hash"];
  }
  // Of each bin, without the lamp, which would be most of them and of their noise.
  static std::vector<double> bin_sums(const Picture& picture, const Picture& reference) {
    std::vector<double> sums(16);
    for (std::size_t p = 0; p < reference.rgb.pixels(); ++p) {
      if (reference.rgb.values[3 * p] > 2) continue;
      for (std::size_t bin = 0; bin < 16; ++bin)
        sums[bin] += static_cast<double>(picture.spectrum.values[16 * p + bin]);
    }
    return sums;
  }
  TemporaryDirectory directory_;
};

// The last bins are lit by few wavelengths: their means scatter by 0.5 and by 3 % from seed to seed at 16
// samples. So eight films of two samples say how much, and a bin is off by 1 %, or four of their standard
// errors.
TEST_F(SpectralPicture, MatchesPbrtInEveryBin) {
  if (!std::filesystem::exists(corpus() / scene_of_corpus))
    GTEST_SKIP() << "no corpus with " << scene_of_corpus << "; set VITRAIL_CORPUS";
  constexpr int seeds = 8;
  const Picture reference = read_picture(corpus() / "pbrt-v4/ref/01_cornell_spectral.exr");
  ASSERT_EQ(reference.bins.count, 16);
  const std::vector<double> expected = bin_sums(reference, reference);
  std::vector<double> sums(16), squares(16);
  for (int seed = 0; seed < seeds; ++seed) {
    render("a", "4", fmt::format("--spp 2 --seed {}", seed));
    const Picture shown = read_picture(directory_ / "a.exr");
    ASSERT_EQ(shown.bins.count, 16);
    ASSERT_EQ(shown.spectrum.values.size(), reference.spectrum.values.size());
    const std::vector<double> found = bin_sums(shown, reference);
    for (std::size_t bin = 0; bin < 16; ++bin) {
      EXPECT_NEAR(shown.bins.centre_nm(static_cast<int>(bin)),
                  reference.bins.centre_nm(static_cast<int>(bin)), 0.01);
      if (expected[bin] == 0) {
        EXPECT_EQ(found[bin], 0) << bin;  // the light shines from 400 to 700 nm
        continue;
      }
      const double ratio = found[bin] / expected[bin];
      sums[bin] += ratio / seeds, squares[bin] += ratio * ratio / seeds;
    }
  }
  std::string line;
  bool passed = true;
  for (std::size_t bin = 0; bin < 16; ++bin) {
    if (expected[bin] == 0) continue;
    const double error = std::sqrt(std::max(squares[bin] - sums[bin] * sums[bin], 0.0) / (seeds - 1));
    passed &= std::abs(sums[bin] - 1) <= std::max(0.01, 4 * error) && error < 0.03;
    line += fmt::format(" {:.4f} ± {:.4f}", sums[bin], error);
  }
  conclude(passed, "01_cornell_spectral", "mean ratios of the bins" + line);
}

TEST_F(SpectralPicture, IsOnePictureWhateverTheDomains) {
  if (!std::filesystem::exists(corpus() / scene_of_corpus))
    GTEST_SKIP() << "no corpus with " << scene_of_corpus << "; set VITRAIL_CORPUS";
  const std::string crop = "--spp 4 --crop 64,192,64,192 ";
  const std::string one = render("one", "1", crop);
  EXPECT_EQ(render("many", "8", crop + "--threads 3"), one);
  EXPECT_EQ(render("few", "8", crop + "--domain-memory 1 --threads 2 --shuffle-delivery 5"), one);
}

}  // namespace
}  // namespace vitrail::test::spectral_picture_test
