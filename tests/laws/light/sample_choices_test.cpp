// SPDX-License-Identifier: Apache-2.0
// However a picture is sampled, its mean is the same; and each way gives one film, which does not mix with
// those of others.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compare/metrics.h"
#include "compare/ztest.h"
#include "film/develop.h"
#include "film/film_progress.h"
#include "images/image_files.h"
#include "scene/spectra/named_spectra.h"
#include "tests/support/command.h"
#include "tests/support/partitioned_box.h"
#include "tests/support/render.h"
#include "tracer/view/pixel_filter.h"

namespace vitrail::test::sample_choices_test {
namespace {

// A box of coloured walls with lamps of unlike power, one of them small and near, and a block that disperses:
// paths of many events, dispersed or not.
Scene coloured_box(int side) {
  Scene scene;
  auto faces = box_faces({-1, -1, -1}, {1, 1, 1});
  for (auto& face : faces) std::swap(face[1], face[3]);  // fronts inwards
  const std::array<SigmoidSpectrum, 3> colours{{{0, 0.02f, -11}, {0, -0.02f, 11.5f}, {-2e-4f, 0.22f, -59}}};
  for (std::size_t i = 0; i < faces.size(); ++i)
    add_shape(scene, add_quads(scene, {faces[i]}), Material{DiffuseMaterial{colours[i % colours.size()]}});
  const auto add_lamp = [&](float x, float z, float half, float height, float radiance) {
    add_shape(scene,
              add_quads(scene, {{{{x - half, height, z - half},
                                  {x + half, height, z - half},
                                  {x + half, height, z + half},
                                  {x - half, height, z + half}}}}),
              Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{radiance}, true});
  };
  add_lamp(0, 0, 0.3f, 0.99f, 4);
  add_lamp(0.6f, 0.5f, 0.05f, -0.5f, 20);
  scene.lights.push_back(Light{PointLight{{-0.7, 0.2, 0.6}, ConstantSpectrum{0.2f}}, {}});
  add_shape(scene, add_quads(scene, box_faces({-0.6f, -0.6f, 0.1f}, {-0.2f, 0.3f, 0.4f})),
            Material{DielectricMaterial{bk7()}});
  set_camera(scene, {0, 0, -0.95}, {0, 0, 1}, {0, 1, 0}, 1.6, side, side);
  scene.settings.max_depth = 24;
  return scene;
}

Film rendered(const Scene& scene, int samples, const SampleChoices& choices, std::uint64_t seed = 0) {
  RenderOptions options;
  options.picture.samples_per_pixel = samples;
  options.picture.samples = choices;
  options.picture.seed = seed;
  const Rendered result = render(scene, options);
  EXPECT_EQ(result.stats.refused, Refused{});
  return result.film;
}

// Of X, Y and Z: how far the means are apart over the standard error of that, from the scatter of the pixels'
// differences.
std::array<double, 3> distances(const Film& a, const Film& b) {
  std::array<double, 3> sum{}, squares{};
  for (std::uint32_t i = 0; i < a.pixels(); ++i) {
    const XYZ x = a.mean(i), y = b.mean(i);
    const std::array<double, 3> off{x.x - y.x, x.y - y.y, x.z - y.z};
    for (std::size_t c = 0; c < 3; ++c) sum[c] += off[c], squares[c] += off[c] * off[c];
  }
  for (std::size_t c = 0; c < 3; ++c) sum[c] /= std::sqrt(squares[c]);
  return sum;
}

// Half of the mean square of what two films differ by, in parts of what they show.
double noise(const Film& a, const Film& b) {
  double sum = 0;
  for (std::uint32_t i = 0; i < a.pixels(); ++i) {
    const double x = a.mean(i).y, y = b.mean(i).y;
    sum += (x - y) * (x - y) / ((x + y) * (x + y)) * 2;
  }
  return sum / a.pixels();
}

// A floor under a lamp, and nothing that reflects its light a second time. By the balance heuristic and with
// wavelengths over all of the range the noise of the plain floor was 8e-5; by chance the blend's was 1.2e-2.
TEST(SampleChoices, SmoothLightHasLittleNoise) {
  const auto measured = [](bool blended) {
    Scene scene;
    const auto square = [&](float half, float height) {
      return add_quads(
          scene,
          {{{{-half, height, -half}, {-half, height, half}, {half, height, half}, {half, height, -half}}}});
    };
    MaterialModel floor = DiffuseMaterial{ConstantSpectrum{0.5f}};
    if (blended) {
      for (const float value : {0.1f, 0.8f})
        scene.materials.push_back(Material{DiffuseMaterial{ConstantSpectrum{value}}});
      floor = BlendMaterial{{0}, {1}, 0.4f};
    }
    add_shape(scene, square(10, 0), Material{floor});
    auto lamp = square(0.3f, 3);
    std::swap(scene.meshes[lamp.value].triangles[0][1], scene.meshes[lamp.value].triangles[0][2]);
    std::swap(scene.meshes[lamp.value].triangles[1][1], scene.meshes[lamp.value].triangles[1][2]);
    add_shape(scene, lamp, Material{DiffuseMaterial{ConstantSpectrum{0}}},
              AreaLight{ConstantSpectrum{10}, false});
    set_camera(scene, {0, 2, 0}, {0, 0, 0}, {0, 0, 1}, 0.7, 32, 32);
    return noise(rendered(scene, 64, {}, 1), rendered(scene, 64, {}, 2));
  };
  EXPECT_LT(measured(false), 2e-5);
  EXPECT_LT(measured(true), 2e-3);
}

// A floor of a tenth shows the sky all the same: half of its light comes by the rays that leave it, and none
// of these ends by chance (24 times the noise otherwise).
TEST(SampleChoices, DarkFloorsHaveLittleNoise) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0.1f}}});
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}, {}});
  set_camera(scene, {0, 2, 0}, {0, 0, 0}, {0, 0, 1}, 0.7, 32, 32);
  EXPECT_LT(noise(rendered(scene, 64, {}, 1), rendered(scene, 64, {}, 2)), 1e-4);
}

// A floor behind a wall that hides the sun, under the rest of the sky: neither the sun nor what shines around
// it may win over the rest.
TEST(SampleChoices, ShadowsOfTheSunHaveLittleNoise) {
  Scene scene;
  add_shape(scene, add_quads(scene, {{{{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0.5f}}});
  add_shape(scene, add_quads(scene, {{{{1.5f, 0, -9}, {1.5f, 9, -9}, {1.5f, 9, 9}, {1.5f, 0, 9}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}});
  SkyLight sky;
  sky.light_to_world = rotate(-std::numbers::pi / 2, {1, 0, 0});  // its zenith is y
  sky.to_sun = {0.8, 0, 0.6};
  scene.lights.push_back(Light{sky});
  set_camera(scene, {-2, 2, 0}, {0, 0, 0}, {0, 0, 1}, 0.5, 32, 32);
  EXPECT_LT(noise(rendered(scene, 64, {}, 1), rendered(scene, 64, {}, 2)), 6e-3);
}

struct Way {
  const char* name;
  SamplingChoices sampling;
};

TEST(SampleChoices, AgreeInTheMean) {
  const Scene scene = coloured_box(28);
  const Film usual = rendered(scene, 192, {}, 1);
  for (const Way& way :
       {Way{"again", {}}, Way{"early", {.roulette = Roulette::early}},
        Way{"never", {.roulette = Roulette::never}}, Way{"one wavelength", {.one_wavelength = true}},
        Way{"by power", {.lights = LightChoice::power}}, Way{"one candidate", {.light_candidates = 1}},
        Way{"many candidates", {.light_candidates = most_light_candidates}},
        Way{"one sequence", {.one_sequence = true}},
        Way{"all", {Roulette::early, true, LightChoice::power, 7}}}) {
    const Film film = rendered(scene, 64, {{}, {}, way.sampling});
    const auto z = distances(film, usual);
    const Brightness seen = brightness(film);
    fmt::print("{}: {:.4f} ± {:.4f} of {:.4f}; {:.1f} {:.1f} {:.1f} standard errors off\n", way.name,
               seen.mean, seen.standard_error, brightness(usual).mean, z[0], z[1], z[2]);
    for (const double distance : z) EXPECT_LT(std::abs(distance), 4) << way.name;
    EXPECT_LT(seen.standard_error, 0.01 * seen.mean) << "too noisy to show anything";
  }
}

// A lamp of 6 by 6 pixels in the middle of a dark picture: its light is all there, whatever spreads it.
TEST(SampleChoices, FiltersMoveTheLightAndKeepIt) {
  constexpr int side = 24;
  Scene scene;
  add_shape(scene,
            add_quads(scene, {{{{-.25f, -.25f, 0}, {.25f, -.25f, 0}, {.25f, .25f, 0}, {-.25f, .25f, 0}}}}),
            Material{DiffuseMaterial{ConstantSpectrum{0}}}, AreaLight{ConstantSpectrum{1}});
  OrthographicCamera camera;
  camera.camera_to_world = look_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-1, 1, -1, 1};
  scene.camera = camera;
  scene.film.width = scene.film.height = side;
  scene.film.crop = {0, side, 0, side};
  scene.film.filter = BoxFilter{};
  scene.settings.max_depth = 0;
  constexpr double lamp = 6.0 * 6 / side / side;
  const std::uint32_t beside = side / 2 * side + 8;  // the first pixel to the left of the lamp
  const auto reach = [&](const Film& film) { return film.mean(beside).y / film.mean(beside + 4).y; };
  EXPECT_EQ(reach(rendered(scene, 16, {})), 0);
  struct Spread {
    Filter filter;
    bool reaches;
  };
  for (const auto& [filter, reaches] :
       {Spread{BoxFilter{0.25, 0.25}, false}, Spread{BoxFilter{3, 3}, true}, Spread{TriangleFilter{}, true},
        Spread{GaussianFilter{}, true}, Spread{MitchellFilter{}, true}, Spread{SincFilter{}, true}}) {
    for (const bool splat : {false, true}) {
      const Film film = rendered(scene, 1024, {filter, {}, {.splat = splat}});
      EXPECT_NEAR(brightness(film).mean, lamp, 0.004 * lamp) << filter.index() << splat;
      if (reaches)
        EXPECT_GT(std::abs(reach(film)), 0.01) << filter.index() << splat;
      else
        EXPECT_EQ(reach(film), 0);
    }
  }
}

// Of each pixel, what its two groups say of its error is true on the average, though the errors of neighbours
// are alike; and there is less of it than where the filter chooses where samples lie.
TEST(SampleChoices, SplattingHasLessErrorAndSaysHowMuch) {
  const Scene scene = lit_box(12);
  const auto errors = [&](bool splat) {
    const SampleChoices ways{GaussianFilter{}, {}, {.splat = splat}};
    const Film truth = rendered(scene, 512, ways, 99);
    double squares = 0, said = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Film film = rendered(scene, 16, ways, seed);
      for (std::uint32_t p = 0; p < film.pixels(); ++p) {
        const double off = film.mean(p).y - truth.mean(p).y;
        squares += off * off, said += film.variance_of_mean(p);
      }
    }
    fmt::print("{}: error {:.4g}, said {:.4g}\n", splat ? "splatted" : "chosen", squares, said);
    EXPECT_NEAR(said / squares, 1, 0.35) << splat;
    return squares;
  };
  EXPECT_LT(errors(true), 0.6 * errors(false));
}

// Where light is smooth, samples that are stratified together have less error than those of two groups. Of it
// their groups would say several times as much, so the film says nothing.
TEST(SampleChoices, OneSequenceHasLessErrorAndDoesNotSayHowMuch) {
  const Scene scene = lit_box(16);
  const Film truth = rendered(scene, 2048, {}, 99);
  const auto error = [&](bool one) {
    double squares = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Film film = rendered(scene, 16, {{}, {}, {.one_sequence = one}}, seed);
      EXPECT_EQ(develop(film).variance.pixels() == 0, one);
      for (std::uint32_t p = 0; p < film.pixels(); ++p) {
        const double off = film.mean(p).y - truth.mean(p).y;
        squares += off * off;
        if (one) {
          EXPECT_EQ(film.variance_of_mean(p), 0);
        }
      }
    }
    return squares;
  };
  const double one = error(true), two = error(false);
  fmt::print("one sequence: error {:.4g}, two: {:.4g}\n", one, two);
  EXPECT_LT(one, 0.97 * two);
}

// How far a picture's mean is from the truth, against what compare and ztest say: over 60 seeds the standard
// deviation is within 30 % (χ² of 59 degrees is, but for 1 in 1000). Were neighbours taken for independent,
// it would be 2 times what is said for the box, 1.8 times for the Gaussian.
TEST(SampleChoices, MeansOfSplattedPicturesAreAsFarOffAsIsSaid) {
  const Scene scene = lit_box(16);
  constexpr int seeds = 60;
  for (const Filter& filter : {Filter{BoxFilter{0.5, 0.5}}, Filter{BoxFilter{1, 1}}, Filter{GaussianFilter{}},
                               Filter{MitchellFilter{}}}) {
    const SampleChoices ways{filter, {}, {.splat = true}};
    const Neighbours neighbours = FilterSampler(filter, true).neighbours();
    const Film truth = rendered(scene, 1024, ways, 999);  // a sixteenth of a picture's error
    const Image true_image = develop(truth).rgb;
    double squares = 0, said = 0, sigmas = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const Picture picture = develop(rendered(scene, 4, ways, seed));
      const double off = mean_ratios(picture.rgb, true_image).luminance - 1;
      const double error = luminance_ratio_error(picture.rgb, true_image, neighbours.of_mean);
      squares += off * off / seeds, said += error * error / seeds;
      ZTestInput input{&picture.rgb, &true_image, {}, {}, 0, neighbours.of_mean};
      input.variance.assign(picture.variance.values.begin(), picture.variance.values.end());
      const double z = ztest(input).mean_sigmas;
      sigmas += z * z / seeds;
    }
    fmt::print("filter {}: {:.2f} neighbours, off {:.3g} %, said {:.3g} %, {:.2f} sigmas\n", filter.index(),
               neighbours.of_mean, 100 * std::sqrt(squares), 100 * std::sqrt(said), std::sqrt(sigmas));
    EXPECT_NEAR(std::sqrt(squares / said), 1, 0.3) << filter.index();
    EXPECT_NEAR(std::sqrt(sigmas), 1, 0.3) << filter.index();
  }
}

// An image far away, that its scene filters in one way or another, lit by itself.
Scene with_image(const std::filesystem::path& image, TextureFilter filter) {
  Scene scene = lit_box(16);
  ImageTexture texture;
  texture.filename = image.string();
  texture.filter = filter;
  scene.textures.push_back({texture, false, "", {}});
  scene.meshes[0].uvs.resize(scene.meshes[0].positions.size());
  for (std::size_t i = 0; i < scene.meshes[0].uvs.size(); ++i)
    scene.meshes[0].uvs[i] = {i % 4 == 1 || i % 4 == 2 ? 1.0f : 0.0f, i % 4 >= 2 ? 1.0f : 0.0f};
  scene.materials[0] = Material{DiffuseMaterial{Id<Texture>{0}}};
  return scene;
}

TEST(SampleChoices, ImagesAreSeenAsIfTheSceneHadSaidSo) {
  const TemporaryDirectory folder;
  Image image{.width = 64, .height = 64, .channels = 3, .values = {}};
  for (int i = 0; i < 64 * 64; ++i)
    for (int c = 0; c < 3; ++c) image.values.push_back((i / 64 / 3 + i % 64 / 3) % 2 ? 0.9f : 0.1f);
  write_exr_image(folder / "cells.exr", image);
  const auto scene = [&](TextureFilter filter) { return with_image(folder / "cells.exr", filter); };
  const auto film = [&](TextureFilter own, std::optional<TextureChoice> choice) {
    return rendered(scene(own), 4, {{}, choice, {}});
  };
  const Film filtered = film(TextureFilter::trilinear, {}), plain = film(TextureFilter::bilinear, {}),
             nearest = film(TextureFilter::nearest, {});
  EXPECT_NE(filtered.hash(), plain.hash());
  EXPECT_NE(plain.hash(), nearest.hash());
  const Film unfiltered = film(TextureFilter::trilinear, TextureChoice::unfiltered);
  EXPECT_EQ(unfiltered.hash(), plain.hash());
  EXPECT_THAT(difference(unfiltered, filtered), testing::HasSubstr("the way to sample"));
  EXPECT_EQ(film(TextureFilter::trilinear, TextureChoice::nearest).hash(), nearest.hash());
  EXPECT_EQ(film(TextureFilter::nearest, TextureChoice::unfiltered).hash(), nearest.hash());
  EXPECT_EQ(difference(film(TextureFilter::bilinear, TextureChoice::unfiltered), plain), "");
}

class OnePictureOfSamples : public PartitionedBox {
 protected:
  OnePictureOfSamples() : PartitionedBox(8) {}
  CommandResult render(const std::string& film, int ranks, const std::string& options) const {
    return run(fmt::format("{} '{}' -o '{}' --width 32 --spp 4 --quiet --stats '{}' {}",
                           ranks > 1 ? mpi_vitrail("render", ranks) : vitrail("render"), path("box.vit"),
                           path(film), path(film + ".json"), options));
  }
  std::string hash(const std::string& film) const { return read_json(path(film + ".json"))["film_hash"]; }
};

// What the film knows of its neighbours goes with its picture, and widens what compare says.
TEST_F(OnePictureOfSamples, PicturesSayThatNeighboursAreAlike) {
  ASSERT_EQ(render("own.film", 1, "").status, 0);
  ASSERT_EQ(render("splat.film", 1, "--splat --filter box:1").status, 0);
  ASSERT_EQ(
      run(fmt::format("{} '{}' -o '{}'", vitrail("develop"), path("splat.film"), path("splat.exr"))).status,
      0);
  const auto error = [&](const std::string& file) {
    const CommandResult done =
        run(fmt::format("{} --json '{}' '{}'", vitrail("compare"), path(file), path("own.film")));
    EXPECT_EQ(done.status, 0) << done.output;
    return nlohmann::json::parse(done.output).at("luminance_ratio_error").get<double>();
  };
  const Image splatted = develop(read_film(path("splat.film"), nullptr)).rgb,
              own = develop(read_film(path("own.film"), nullptr)).rgb;
  EXPECT_GT(error("splat.film"), 1.1 * luminance_ratio_error(splatted, own));
  EXPECT_NEAR(error("splat.exr"), luminance_ratio_error(splatted, own, 4), 1e-3 * error("splat.exr"));
}

TEST_F(OnePictureOfSamples, HoweverItIsRendered) {
  for (const std::string choices :
       {"--filter mitchell:1 --roulette early --wavelengths 1 --light-sampling power --light-candidates 7 "
        "--one-sequence",
        "--splat --filter gaussian:1.5 --spectral 3 --clamp 1 --aov albedo,depth,normal"}) {
    ASSERT_EQ(render("a.film", 1, choices + " --force --threads 2").status, 0);
    for (const char* manner : {"--threads 1", "--threads 2 --domain-memory 1 --shuffle-delivery 5"}) {
      const CommandResult done = render("b.film", 2, choices + " --force " + manner);
      ASSERT_EQ(done.status, 0) << done.output;
      EXPECT_EQ(hash("b.film"), hash("a.film")) << manner;
    }
    EXPECT_GT(read_json(path("b.film.json"))["forwarded_rays"].get<int>(), 0);
  }
}

TEST_F(OnePictureOfSamples, WaysDoNotMix) {
  ASSERT_EQ(render("usual.film", 1, "").status, 0);
  ASSERT_EQ(render("same.film", 1,
                   "--roulette default --wavelengths 4 --light-sampling tree --light-candidates 4 "
                   "--texture-filter none")
                .status,
            0);
  EXPECT_EQ(hash("same.film"), hash("usual.film"));
  for (const char* way : {"--filter box:0.25", "--splat", "--one-sequence", "--roulette never",
                          "--wavelengths 1", "--light-sampling power", "--light-candidates 5"}) {
    // A film is not gone on with in another way.
    CommandResult result = render("usual.film", 1, way);
    EXPECT_EQ(result.status, 3) << way;
    EXPECT_THAT(result.output,
                testing::HasSubstr(std::string("way to sample: as usual, this command has ") + way))
        << way;
    ASSERT_EQ(render("other.film", 1, std::string("--force --seed 1 ") + way).status, 0);
    result = run(fmt::format("{} '{}' '{}' -o '{}'", vitrail("develop"), path("usual.film"),
                             path("other.film"), path("both.exr")));
    EXPECT_EQ(result.status, 3) << way;
    EXPECT_THAT(result.output, testing::HasSubstr("the way to sample")) << way;
    result = run(fmt::format("{} '{}'", vitrail("inspect"), path("other.film")));
    EXPECT_THAT(result.output, testing::HasSubstr(way));
  }
}

}  // namespace
}  // namespace vitrail::test::sample_choices_test
