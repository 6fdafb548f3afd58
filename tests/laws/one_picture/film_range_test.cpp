// SPDX-License-Identifier: Apache-2.0
// Light of every size is counted, and the same on any number of ranks.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/ranks.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::film_range_test {
namespace {

class FilmRange : public ::testing::Test {
 protected:
  // A lamp that fills the picture, and a diffuse floor that no camera ray meets but that lights up and is
  // lit.
  std::filesystem::path lamp(double radiance) {
    const std::filesystem::path file = directory_ / fmt::format("{:g}.pbrt", radiance);
    std::ofstream(file) << fmt::format(
        "LookAt 0 0 0  0 0 1  0 1 0 Camera \"perspective\" \"float fov\" 40\n"
        "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 12\n"
        "Integrator \"path\" \"integer maxdepth\" 3 WorldBegin\n"
        "AttributeBegin Material \"diffuse\" \"rgb reflectance\" [0 0 0] AreaLightSource \"diffuse\" \"rgb "
        "L\" [{0} {0} {0}] \"bool twosided\" true\n"
        "Shape \"trianglemesh\" \"point3 P\" [-9 -9 2  9 -9 2  9 9 2  -9 9 2] \"integer indices\" [0 1 2 0 2 "
        "3]\n"
        "AttributeEnd Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n"
        "Shape \"trianglemesh\" \"point3 P\" [-9 -9 -2  9 -9 -2  9 9 -2  -9 9 -2] "
        "\"integer indices\" [0 1 2 0 2 3]\n",
        radiance);
    return file;
  }
  std::filesystem::path bundle(const std::filesystem::path& scene) {
    std::filesystem::path out = scene;
    out.replace_extension(".vit");
    const CommandResult made = run(fmt::format("{} '{}' -o '{}' --domains 2 --quiet", vitrail("partition"),
                                               scene.string(), out.string()));
    EXPECT_EQ(made.status, 0) << made.output;
    return out;
  }
  CommandResult render(const std::filesystem::path& of, int ranks, int samples) {
    return run(fmt::format("{} '{}' -o '{}' --force --spp {} --threads 1 --stats '{}'",
                           vitrail_on(ranks, "render"), of.string(), film_.string(), samples,
                           stats_.string()));
  }
  std::string hash() { return read_json(stats_)["film_hash"]; }

  TemporaryDirectory directory_;
  std::filesystem::path film_ = directory_ / "a.film", stats_ = directory_ / "stats.json";
};

TEST_F(FilmRange, OneFilmOfEveryRadianceOnOneToSevenRanks) {
  // With VITRAIL_LONG_TESTS each radiance on each number of ranks, else on one and on another number.
  const bool all = std::getenv("VITRAIL_LONG_TESTS");
  int other = 1;
  for (const double radiance : {1e-30, 1e-8, 1.0, 1e7, 2.5e8, 1e30}) {
    const std::filesystem::path scene = bundle(lamp(radiance));
    std::string first;
    ++other;
    for (int ranks = 1; ranks <= 7; ++ranks) {
      if (!all && ranks != 1 && ranks != other) continue;
      const CommandResult done = render(scene, ranks, 16);
      ASSERT_EQ(done.status, 0) << radiance << " on " << ranks << " ranks: " << done.output;
      if (ranks == 1) first = hash();
      EXPECT_EQ(hash(), first) << radiance << " on " << ranks << " ranks";
    }
    const Brightness seen = brightness(read_film(film_, nullptr));
    EXPECT_NEAR(seen.mean / radiance, 1, 4 * seen.standard_error / radiance + 1e-6);
    EXPECT_LT(seen.standard_error / radiance, 0.01);
  }
}

// A sun of 10⁹ that is seen, with as many samples as a picture may have.
TEST_F(FilmRange, ASunOfManySamples) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1e9f}, false});
  set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.5, 3, 3);
  const Rendered rendered = test::render(scene, 4096);
  EXPECT_EQ(rendered.stats.refused, Refused{});
  const Brightness seen = brightness(rendered.film);
  EXPECT_NEAR(seen.mean / 1e9, 1, 4 * seen.standard_error / 1e9 + 1e-6);
}

// Lights of 10⁻⁸ and 10⁹ in one scene, each before half of the picture. What the dim one sends to itself by
// way of a floor has to be there, too.
TEST_F(FilmRange, DimAndBrightTogether) {
  Scene scene;
  const auto emitter = [](float radiance) { return AreaLight{ConstantSpectrum{radiance}, false}; };
  const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
  add_shape(scene, add_quads(scene, {{{{-9, -9, 2}, {-9, 9, 2}, {0, 9, 2}, {0, -9, 2}}}}), black,
            emitter(1e-8f));
  add_shape(scene, add_quads(scene, {{{{0, -9, 2}, {0, 9, 2}, {9, 9, 2}, {9, -9, 2}}}}), black,
            emitter(1e9f));
  set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.5, 16, 8);
  const Rendered rendered = test::render(scene, 64);
  EXPECT_EQ(rendered.stats.refused, Refused{});
  double left = 0, right = 0, error = 0;
  for (std::uint32_t p = 0; p < rendered.film.pixels(); ++p) {
    const double y = rendered.film.mean(p).y;
    (y < 1 ? left : right) += y / 64;
    if (y < 1) error += rendered.film.variance_of_mean(p) / 64 / 64;
  }
  EXPECT_NEAR(left / 1e-8, 1, 4 * std::sqrt(error) / 1e-8 + 1e-6);
  EXPECT_NEAR(right / 1e9, 1, 0.01);
}

// Light far below what a film resolves is there on the average: a lamp of 10⁻⁸ in a fog that lets through
// e⁻¹⁸ = 1.5·10⁻⁸ of it, while a sun of 10⁹ shines elsewhere.
TEST_F(FilmRange, NothingVanishes) {
  Scene scene;
  const auto emitter = [](float radiance) { return AreaLight{ConstantSpectrum{radiance}, false}; };
  const Material black{DiffuseMaterial{ConstantSpectrum{0}}};
  add_shape(scene, add_quads(scene, {{{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}}}), black,
            emitter(1e-8f));
  add_shape(scene, add_quads(scene, {{{{-1, -1, -2}, {-1, 1, -2}, {1, 1, -2}, {1, -1, -2}}}}), black,
            emitter(1e9f));
  Medium fog;
  fog.coefficients = AbsorptionScattering{ConstantSpectrum{9}, ConstantSpectrum{0}};
  scene.media.push_back(fog);
  scene.camera_medium = Id<Medium>{0};
  set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1e-3, 16, 16);
  const Rendered rendered = test::render(scene, 4096);
  const double expected = 1e-8 * std::exp(-18.0);
  EXPECT_LT(expected, 0.001 * std::ldexp(1, rendered.film.exponent()));
  const Brightness seen = brightness(rendered.film);
  EXPECT_LT(seen.standard_error, 0.15 * expected);
  EXPECT_NEAR(seen.mean, expected, 4 * seen.standard_error);
}

// Before half of a lamp stands a sheet that lets through 10³⁰ times what meets it: no range of the lights
// covers that.
TEST_F(FilmRange, SaturationFailsAlikeOnAnyNumberOfRanks) {
  const std::filesystem::path scene = directory_ / "sheet.xml";
  std::ofstream(scene) << R"(<scene version="3.0.0"><integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="90"/>
      <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="24"/></film></sensor>
    <shape type="rectangle"><transform name="to_world"><scale x=".2"/><translate z=".5"/></transform>
      <bsdf type="thindielectric"><spectrum name="specular_transmittance" value="1e30"/></bsdf></shape>
    <shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/><translate z="1"/></transform>
      <emitter type="area"><spectrum name="radiance" value="1"/></emitter></shape></scene>)";
  const std::filesystem::path of = bundle(scene);
  std::string first;
  std::uint64_t refused = 0;
  for (const int ranks : {1, 2, 5}) {
    const CommandResult done = render(of, ranks, 4);
    EXPECT_EQ(done.status, 3) << ranks << " ranks: " << done.output;
    EXPECT_THAT(done.output, ::testing::HasSubstr("the film is saturated"));
    if (ranks == 1) first = hash(), refused = read_json(stats_)["saturated_samples"];
    EXPECT_EQ(hash(), first) << ranks << " ranks";
    EXPECT_EQ(read_json(stats_)["saturated_samples"], refused) << ranks << " ranks";
  }
  EXPECT_GT(refused, 0u);
  EXPECT_EQ(
      run(fmt::format("{} '{}' -o '{}'", vitrail("develop"), film_.string(), (directory_ / "a.exr").string()))
          .status,
      3);
}

}  // namespace
}  // namespace vitrail::test::film_range_test
