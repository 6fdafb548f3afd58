// SPDX-License-Identifier: Apache-2.0
// Scenes that nobody here made, against pictures by another renderer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {
namespace {

struct Agreement {
  const char* scene;
  const char* reference;
  int width, height;  // of the reference: some are smaller than the scene asks for
  int samples;
  double reference_samples;  // a pixel
  const char* needs;         // arguments of the render
};

void PrintTo(const Agreement& a, std::ostream* out) { *out << a.scene; }

class Corpus : public ::testing::TestWithParam<Agreement> {};

// The scene with the reference's resolution, in a folder where the files it names are found.
std::filesystem::path resized(const TemporaryDirectory& directory, const std::filesystem::path& scene, int w,
                              int h) {
  std::filesystem::copy(scene.parent_path(), directory / "scene", std::filesystem::copy_options::recursive);
  std::ifstream in(scene);
  std::string text(std::istreambuf_iterator<char>(in), {});
  text = std::regex_replace(text, std::regex(R"("integer xresolution"\s*\[\s*\d+\s*\])"),
                            fmt::format("\"integer xresolution\" [{}]", w));
  text = std::regex_replace(text, std::regex(R"("integer yresolution"\s*\[\s*\d+\s*\])"),
                            fmt::format("\"integer yresolution\" [{}]", h));
  const std::filesystem::path copy = directory / "scene" / scene.filename().string();
  std::ofstream(copy) << text;
  return copy;
}

// Mean luminance within 1 %; what remains of relMSE must be noise: it is that of the two pictures' own
// variances, and falls as 1/n, which two films of different seeds show.
TEST_P(Corpus, AgreesWithItsReference) {
  const Agreement& a = GetParam();
  const std::filesystem::path root = corpus();
  if (root.empty()) GTEST_SKIP() << "there is no corpus here; set VITRAIL_CORPUS";
  const TemporaryDirectory directory;
  const std::filesystem::path scene = resized(directory, root / a.scene, a.width, a.height);
  const std::string bundle = (directory / "scene.vit").string();
  const CommandResult made =
      run(fmt::format("{} '{}' -o '{}' --domains 4", vitrail("partition"), scene.string(), bundle));
  ASSERT_EQ(made.status, 0) << made.output;
  for (const int seed : {1, 2}) {
    const CommandResult done =
        run(fmt::format("{} '{}' -o '{}' --spp {} --seed {} {}", vitrail("render"), bundle,
                        (directory / fmt::format("{}.exr", seed)).string(), a.samples, seed, a.needs));
    ASSERT_EQ(done.status, 0) << done.output;
  }
  const auto compare = [&](const std::filesystem::path& image, const std::filesystem::path& with) {
    const CommandResult result = run(fmt::format("{} '{}' '{}' --metric relmse --json", vitrail("compare"),
                                                 image.string(), with.string()));
    EXPECT_EQ(result.status, 0) << result.output;
    return nlohmann::json::parse(result.output);
  };
  const auto against = compare(directory / "1.exr", root / a.reference);
  const auto own = compare(directory / "1.exr", directory / "2.exr");
  // E[(a − b)²] of two independent pictures of variance v/n each: own = 2v/n, against = v/n + v/n_reference.
  const double noise = own["value"].get<double>() / 2 * (1 + a.samples / a.reference_samples);
  const double ratio = against["luminance_ratio"];
  fmt::print("{:44} luminance {:.4f}  relmse {:.5f}, noise explains {:.5f}\n", a.scene, ratio,
             against["value"].get<double>(), noise);
  EXPECT_NEAR(ratio, 1, 0.01);
  EXPECT_LT(against["value"].get<double>(), 1.5 * noise + 2e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Pbrt, Corpus,
    ::testing::Values(
        Agreement{"pbrt/cornell-box/scene.pbrt", "pbrt/cornell-box/scene_ref_pbrtv4.exr", 512, 512, 8, 128,
                  ""},
        Agreement{"pbrt/spheres-point/cornell.pbrt", "pbrt/spheres-point/cornell_ref_pbrtv4.exr", 400, 400,
                  16, 256, ""},
        Agreement{"pbrt-v4/scenes/01_cornell.pbrt", "pbrt-v4/ref/01_cornell.exr", 256, 256, 32, 256, ""},
        Agreement{"pbrt-v4/scenes/04_prism.pbrt", "pbrt-v4/ref/04_prism.exr", 256, 192, 128, 512, ""}));

}  // namespace
}  // namespace vitrail::test
