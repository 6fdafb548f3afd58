// SPDX-License-Identifier: Apache-2.0
// develop and compare as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "film/film_progress.h"
#include "film/image_io.h"
#include "film/picture_extent.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::image_programs_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ImagePrograms : public testing::Test {
 protected:
  // A film of 16 samples a pixel, the luminance of sample s being 1 or 3 in turn; returns its name, quoted.
  std::string film(const std::string& name, std::uint64_t seed, std::uint64_t scene = 1, int max_depth = 5) {
    FilmSettings settings;
    settings.width = settings.height = 8;
    settings.crop = {0, 8, 0, 8};
    Film f(settings, {scene, seed, max_depth});
    for (std::uint32_t p = 0; p < 64; ++p)
      for (std::uint32_t s = 0; s < 16; ++s) {
        f.count_sample(p, s);
        f.deposit(p, s, srgb_to_xyz(s % 2 == 0 ? RGB{1, 1, 1} : RGB{3, 3, 3}));
      }
    write_film(directory_ / name, f, {1, 16, {1}, 1});
    return quoted(name);
  }
  std::string quoted(const std::string& name) const { return '\'' + (directory_ / name).string() + '\''; }

  CommandResult develop(const std::string& arguments) { return run(vitrail("develop") + ' ' + arguments); }
  CommandResult compare(const std::string& arguments) { return run(vitrail("compare") + ' ' + arguments); }

  TemporaryDirectory directory_;
};

TEST_F(ImagePrograms, DevelopMergesSeedsInAnyOrder) {
  const std::string a = film("a.film", 1), b = film("b.film", 2);
  ASSERT_EQ(develop(a + ' ' + b + " -o " + quoted("ab.exr")).status, 0);
  ASSERT_EQ(develop(b + ' ' + a + " -o " + quoted("ba.exr")).status, 0);
  EXPECT_EQ(run("cmp " + quoted("ab.exr") + ' ' + quoted("ba.exr")).status, 0);
  const Picture picture = read_picture(directory_ / "ab.exr");
  EXPECT_EQ(picture.samples_per_pixel, 32);
  EXPECT_NEAR(picture.rgb.values[0], 2, 1e-5);
}

TEST_F(ImagePrograms, BitwiseLooksAtAlpha) {
  Picture picture;
  picture.rgb = black_image(2, 1, 3);
  picture.window = {0, 2, 0, 1};
  picture.full_width = 2, picture.full_height = 1;
  const auto write = [&](const char* name, float alpha) {
    picture.layers = {{"A", false, {1, alpha}, {}}};
    write_picture(directory_ / name, picture);
    return quoted(name);
  };
  for (const char* kind : {".exr", ".png"}) {
    const std::string a = write(("a" + std::string(kind)).c_str(), 1),
                      b = write(("b" + std::string(kind)).c_str(), .5f);
    EXPECT_EQ(compare(a + ' ' + a + " --metric bitwise").status, 0);
    const CommandResult differs = compare(a + ' ' + b + " --metric bitwise");
    EXPECT_EQ(differs.status, 1) << kind;
    EXPECT_THAT(differs.output, AllOf(HasSubstr("0.5"), HasSubstr("alpha differs in 1 pixel\n")));
    const CommandResult colors = compare(a + ' ' + b + " --metric mse --fail-above 0");
    EXPECT_EQ(colors.status, 0) << "colours alone";
    EXPECT_THAT(colors.output, HasSubstr("alpha differs in 1 pixel, which this metric does not look at\n"));
    EXPECT_THAT(compare(a + ' ' + a + " --json").output, HasSubstr("\"alpha_differs\":0"));
  }
}

TEST_F(ImagePrograms, FilmsThatAreNotFinishedAreNamedOrRefused) {
  const std::string a = film("a.film", 1);
  FilmProgress progress;
  const Film begun = read_film(directory_ / "a.film", &progress);
  progress.done = {0};
  write_film(directory_ / "b.film", begun, progress);
  const CommandResult named = compare(a + ' ' + quoted("b.film"));
  EXPECT_EQ(named.status, 0);
  EXPECT_THAT(named.output, HasSubstr("b.film: the film is not finished"));
  EXPECT_EQ(compare(a + ' ' + quoted("b.film") + " --strict").status, 3);
  EXPECT_EQ(compare(a + ' ' + a + " --strict").status, 0);
  EXPECT_EQ(develop(quoted("b.film") + " --strict -o " + quoted("b.png")).status, 3);
}

TEST_F(ImagePrograms, PicturesForScreensAreToneMapped) {
  const std::string a = film("a.film", 1);  // of luminance 2
  const auto shown = [&](const std::string& more) {
    EXPECT_EQ(develop(a + " -o " + quoted("a.png") + ' ' + more).status, 0) << more;
    return read_picture(directory_ / "a.png").rgb.values[1];
  };
  EXPECT_EQ(shown(""), 1);
  EXPECT_GT(shown("--tone aces"), 0.75f);
  EXPECT_LT(shown("--tone aces"), 0.85f);
  EXPECT_LT(shown("--tone aces --exposure -3.474"), 0.12f);  // 18 %
  const CommandResult light = develop(a + " -o " + quoted("a.exr") + " --tone aces");
  EXPECT_EQ(light.status, 2);
  EXPECT_THAT(light.output, HasSubstr("--tone is for screens"));
}

TEST_F(ImagePrograms, DevelopExposes) {
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.exr") + " --exposure -1 --variance").status, 0);
  const Picture picture = read_picture(directory_ / "a.exr");
  EXPECT_NEAR(picture.rgb.values[0], 1, 1e-5);
  EXPECT_EQ(picture.variance.pixels(), 64u);
}

TEST_F(ImagePrograms, DevelopRefusesDoubleSeedsAndStrangers) {
  const std::string a = film("a.film", 1), again = film("again.film", 1), other = film("other.film", 2, 9);
  const CommandResult twice = develop(a + ' ' + again + " -o " + quoted("x.exr"));
  EXPECT_EQ(twice.status, 3);
  EXPECT_THAT(twice.output, HasSubstr("seed 1"));
  const CommandResult mixed = develop(a + ' ' + other + " -o " + quoted("x.exr"));
  EXPECT_EQ(mixed.status, 3);
  EXPECT_THAT(mixed.output, HasSubstr("differ in the scene"));
  const CommandResult same_seed = develop(a + ' ' + film("stranger.film", 1, 9) + " -o " + quoted("x.exr"));
  EXPECT_EQ(same_seed.status, 3);
  EXPECT_THAT(same_seed.output,
              AllOf(HasSubstr("differ in the scene"), HasSubstr("a.film"), HasSubstr("stranger.film")));
  const std::string deeper = film("deeper.film", 3, 1, 8);
  const CommandResult unequal = develop(a + ' ' + deeper + " -o " + quoted("x.exr"));
  EXPECT_EQ(unequal.status, 3);
  EXPECT_THAT(unequal.output, HasSubstr("their depths differ: 5 and 8"));
  EXPECT_THAT(unequal.output, AllOf(HasSubstr("a.film"), HasSubstr("deeper.film")));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "x.exr"));
}

TEST_F(ImagePrograms, WrongUsageIsTwoAndHelpIsZero) {
  EXPECT_EQ(develop("").status, 2);
  EXPECT_EQ(develop("--help").status, 0);
  EXPECT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.gif")).status, 2);
  EXPECT_EQ(compare("a b --metric nonsense").status, 2);
  EXPECT_EQ(compare("a b --metric psnr --fail-above 3").status, 2);
  EXPECT_EQ(compare(quoted("no.exr") + ' ' + quoted("no.exr")).status, 3);
}

TEST_F(ImagePrograms, CompareTakesFilmsAndImages) {
  const std::string a = film("a.film", 1);
  ASSERT_EQ(develop(a + " -o " + quoted("a.exr")).status, 0);
  EXPECT_EQ(compare(a + ' ' + quoted("a.exr") + " --metric bitwise").status, 0);
  EXPECT_EQ(compare(a + ' ' + quoted("a.exr") + " --metric ztest").status, 0);
  const CommandResult json = compare(a + ' ' + quoted("a.exr") + " --json");
  EXPECT_THAT(json.output, HasSubstr("\"value\":0.0"));
}

TEST_F(ImagePrograms, CompareResizesWhereItIsAsked) {
  const std::string a = film("a.film", 1);
  ASSERT_EQ(develop(a + " -o " + quoted("half.exr") + " --resize 50%").status, 0);
  EXPECT_EQ(compare(quoted("half.exr") + ' ' + a).status, 3);
  EXPECT_EQ(compare(quoted("half.exr") + ' ' + a + " --resize --fail-above 1e-6").status, 0);
  EXPECT_EQ(compare(a + ' ' + quoted("half.exr") + " --resize --fail-above 1e-6").status, 0);
}

TEST_F(ImagePrograms, CompareByStructureAndByTiles) {
  const std::string a = film("a.film", 1), b = film("b.film", 2);
  EXPECT_THAT(compare(a + ' ' + a + " --metric ssim").output, HasSubstr("ssim 1\n"));
  EXPECT_EQ(compare(a + ' ' + a + " --metric ssim --fail-above 1").status, 2);
  const CommandResult same = compare(a + ' ' + b + " --metric welch --heatmap " + quoted("p.exr"));
  EXPECT_EQ(same.status, 0) << same.output;
  EXPECT_THAT(same.output, HasSubstr("p-values of 1 tiles of 8 × 8 pixels"));
  EXPECT_EQ(read_picture(directory_ / "p.exr").rgb.width, 8);
  ASSERT_EQ(develop(a + " -o " + quoted("a.exr")).status, 0);
  EXPECT_EQ(compare(a + ' ' + quoted("a.exr") + " --metric welch").status, 2) << "it knows no variance";
  EXPECT_EQ(compare(a + ' ' + b + " --metric welch --ignore 0,1,0,1").status, 2);
}

TEST_F(ImagePrograms, CompareFailsAboveTheThresholdAndShowsWhere) {
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.exr")).status, 0);
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("b.exr") + " --exposure 0.1").status, 0);
  const std::string both = quoted("b.exr") + ' ' + quoted("a.exr");
  EXPECT_EQ(compare(both).status, 0);
  const CommandResult failed = compare(both + " --fail-above 0.001 --heatmap " + quoted("heat.png"));
  EXPECT_EQ(failed.status, 1);
  EXPECT_THAT(failed.output, HasSubstr("luminance 1.0717"));
  EXPECT_EQ(read_picture(directory_ / "heat.png").rgb.width, 8);
  EXPECT_EQ(compare(both + " --metric bitwise").status, 1);
  EXPECT_EQ(compare(both + " --metric ztest").status, 2);
}

TEST_F(ImagePrograms, CompareByFlipAndAsAPage) {
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.exr")).status, 0);
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("b.exr") + " --exposure 0.5").status, 0);
  const std::string both = quoted("b.exr") + ' ' + quoted("a.exr");
  const CommandResult flip = compare(both + " --metric flip --fail-above 0.001 --ignore 0,4,0,8 --heatmap " +
                                     quoted("flip.exr") + " --html " + quoted("page.html"));
  EXPECT_EQ(flip.status, 1) << flip.output;
  EXPECT_THAT(flip.output, AllOf(HasSubstr("flip 0."), HasSubstr("compared 32 pixels")));
  const Image map = read_picture(directory_ / "flip.exr").rgb;
  EXPECT_EQ(map.values[0], 0);  // left out
  EXPECT_GT(map.values[3 * 5], 0.01f);
  std::ifstream in(directory_ / "page.html");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  EXPECT_THAT(page, AllOf(HasSubstr("relmse"), HasSubstr("b.exr"), HasSubstr("</html>")));
  // On a screen both are white.
  EXPECT_EQ(compare(both + " --metric flip --flip-range ldr --fail-above 0").status, 0);
}

TEST_F(ImagePrograms, CompareByMitsubasRule) {
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.exr")).status, 0);
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("b.exr") + " --exposure 0.05").status, 0);
  const std::string both = quoted("b.exr") + ' ' + quoted("a.exr");
  const std::string rule = both + " --metric ztest --variance " + quoted("a.exr") + " --json";
  const CommandResult json = compare(rule);  // a.exr: the variance of a sample is 2, its mean is off by 0.07
  EXPECT_EQ(json.status, 0) << json.output;
  EXPECT_THAT(json.output, HasSubstr("\"mean_ratio_z\":1.035"));
  EXPECT_EQ(compare(rule + " --mean-within 0.01").status, 1);
  EXPECT_EQ(compare(rule + " --variance-samples 10000").status, 1);
}

TEST_F(ImagePrograms, CompareLeavesOutPixels) {
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.exr")).status, 0);
  Picture picture = read_picture(directory_ / "a.exr");
  picture.rgb.values[3 * 9] = 7;  // of the pixel (1, 1)
  write_picture(directory_ / "b.exr", picture);
  picture.rgb.values[3 * 9] = picture.rgb.values[3 * 9 + 1] = picture.rgb.values[3 * 9 + 2] = 0;
  write_picture(directory_ / "mask.exr", picture);
  const std::string both = quoted("b.exr") + ' ' + quoted("a.exr") + " --metric bitwise";
  EXPECT_EQ(compare(both).status, 1);
  EXPECT_EQ(compare(both + " --ignore 1,2,1,2 --heatmap " + quoted("heat.png")).status, 0);
  EXPECT_EQ(compare(both + " --mask " + quoted("mask.exr")).status, 0);
  EXPECT_EQ(compare(both + " --ignore 2,3,1,2").status, 1);
  EXPECT_EQ(compare(both + " --ignore 1,2,1").status, 2);
}

// A part of a picture is compared with the same part of another.
TEST_F(ImagePrograms, CropsAreComparedWhereTheyLie) {
  Picture whole;
  whole.rgb = black_image(8, 8, 3);
  for (std::size_t i = 0; i < whole.rgb.values.size(); ++i) whole.rgb.values[i] = static_cast<float>(i);
  whole.window = {0, 8, 0, 8}, whole.full_width = whole.full_height = 8;
  write_picture(directory_ / "whole.exr", whole);
  const auto crop = [&](const char* name, const PixelRect& window, float error) {
    Picture part = whole;
    cut_to(part, window);
    part.rgb.values[0] += error;
    write_picture(directory_ / name, part);
    return quoted(name);
  };
  const std::string a = crop("a.exr", {2, 6, 3, 7}, 0), b = crop("b.exr", {4, 8, 5, 8}, 1000);
  EXPECT_EQ(compare(a + ' ' + quoted("whole.exr") + " --metric bitwise").status, 0);
  const CommandResult both = compare(a + ' ' + b + " --metric bitwise");
  EXPECT_EQ(both.status, 1);
  EXPECT_THAT(both.output,
              AllOf(HasSubstr("compared 4 pixels in 4,6,5,7 of 8 × 8"), HasSubstr("bitwise 0.25"),
                    HasSubstr("pixel 4,5: 132 133 134, in the reference 1132 133 134")));
  EXPECT_EQ(compare(a + ' ' + b + " --metric bitwise --ignore 4,5,5,6").status, 0) << "of the whole picture";
  EXPECT_EQ(compare(a + ' ' + crop("c.exr", {0, 2, 0, 4}, 0)).status, 3) << "nothing in common";
}

TEST_F(ImagePrograms, CompareWritesNumbersAndSigns) {
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("a.exr")).status, 0);
  ASSERT_EQ(develop(film("a.film", 1) + " -o " + quoted("b.exr") + " --exposure 1").status, 0);
  const CommandResult done = compare(quoted("a.exr") + ' ' + quoted("b.exr") + " --metric rmse --heatmap " +
                                     quoted("heat.exr") + " --signed-map " + quoted("signed.exr"));
  EXPECT_EQ(done.status, 0);
  EXPECT_THAT(done.output, AllOf(HasSubstr("rmse 2"), HasSubstr("luminance is off by -50 % ± "),
                                 Not(HasSubstr("passed"))));
  EXPECT_NEAR(read_picture(directory_ / "heat.exr").rgb.values[0], 4, 1e-4);  // of rmse, squares
  EXPECT_NEAR(read_picture(directory_ / "signed.exr").rgb.values[0], -2, 1e-4);
  EXPECT_EQ(compare(quoted("a.exr") + ' ' + quoted("b.exr") + " --quiet").output, "");
}

TEST_F(ImagePrograms, DamagedFilmsAreBadInput) {
  const std::string a = film("a.film", 1);
  std::filesystem::resize_file(directory_ / "a.film", 200);
  const CommandResult result = develop(a + " -o " + quoted("a.exr"));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.output, HasSubstr("a.film: the film file is truncated"));
}

}  // namespace
}  // namespace vitrail::test::image_programs_test
