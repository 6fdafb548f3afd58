// SPDX-License-Identifier: Apache-2.0
// Patterns of noise have the numbers that povray writes, at every point: by every noise generator, warped and
// turbulent, and by the language's version.
#include <cmath>
#include <fstream>
#include <random>

#include "scene/models/pattern.h"
#include "scene/models/pattern_normal.h"
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_noise_test {
namespace {

class PovrayNoise : public PovrayPictures {
 protected:
  // What povray writes of `pattern { … }` of each text, at each point.
  std::vector<std::vector<double>> by_povray(const std::vector<std::string>& patterns,
                                             const std::vector<Point3d>& points) {
    std::string scene = "#version 3.7;\n#include \"functions.inc\"\n#fopen Out \"out.txt\" write\n";
    for (std::size_t i = 0; i < patterns.size(); ++i)
      scene += fmt::format("#declare F{} = function {{ {} }}\n", i, function_of(patterns[i]));
    for (const Point3d& p : points)
      for (std::size_t i = 0; i < patterns.size(); ++i)
        scene += fmt::format("#write (Out, str(F{}({}, {}, {}), 0, 15), \"\\n\")\n", i, p.x, p.y, p.z);
    folder_.write("ask.pov", scene + "#fclose Out\ncamera { } sphere { 0, 1 }\n");
    const std::string command = fmt::format("cd '{}' && povray +Iask.pov +W4 +H4 -D +Oask.png > log.txt 2>&1",
                                            folder_.path().string());
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream out(folder_ / "out.txt");
    std::vector<std::vector<double>> values(patterns.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      for (auto& of_pattern : values) out >> of_pattern.emplace_back();
    EXPECT_TRUE(out.good());
    return values;
  }

  PatternTexture read(const std::string& pattern, const std::string& before = "#version 3.7;") {
    folder_.write("scene.pov",
                  before + " plane { z, 0 pigment { " + pattern + " color_map { [0 rgb 0] [1 rgb 1] } } }");
    return std::get<PatternTexture>(read_povray(folder_ / "scene.pov").scene.textures.at(0).model);
  }

  void expect_same(const std::vector<std::string>& patterns, double tolerance) {
    std::vector<Point3d> points;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> within(-12, 12);
    for (int i = 0; i < 40; ++i) points.push_back({within(random), within(random), within(random)});
    points.push_back({1234.5, -2345.6, 98.7});
    const auto theirs = by_povray(patterns, points);
    for (std::size_t i = 0; i < patterns.size(); ++i) {
      const PatternTexture t = read(patterns[i]);
      const Transform to_texture = inverse(t.texture_to_world);
      for (std::size_t k = 0; k < points.size(); ++k) {
        const double ours = pattern_value(t, transform_point(to_texture, points[k]));
        const double apart = std::abs(ours - theirs[i][k]);
        EXPECT_LT(std::min(apart, std::abs(1 - apart)), tolerance)
            << patterns[i] << " at " << points[k].x << " " << points[k].y << " " << points[k].z << ": "
            << ours << " for " << theirs[i][k];
      }
    }
  }

 private:
  static std::string function_of(const std::string& pattern) { return "pattern { " + pattern + " }"; }
};

TEST_F(PovrayNoise, OfPatterns) {
  std::vector<std::string> patterns;
  for (const char* kind : {"agate", "bozo", "bumps", "dents", "granite", "marble ramp_wave", "wrinkles"})
    for (const char* generator : {"", " noise_generator 1", " noise_generator 2"})
      patterns.push_back(std::string(kind) + generator);
  for (const char* kind : {"cells", "crackle", "crackle solid", "crackle form <0, 0, 1>",
                           "crackle form <1, 0.5, 0.25> metric 3 offset 0.2", "ripples frequency 2 phase 0.3",
                           "waves", "waves frequency 3 phase 0.4", "agate agate_turb 2",
                           "bozo sine_wave frequency 3", "granite scallop_wave", "wood", "leopard", "onion"})
    patterns.push_back(kind);
  expect_same(patterns, 1e-6);
}

TEST_F(PovrayNoise, OfTurbulence) {
  std::vector<std::string> patterns;
  for (const char* kind :
       {"agate", "bozo", "cells", "crackle", "granite", "leopard", "marble", "onion", "ripples", "spiral1 3",
        "waves", "wood", "wrinkles", "gradient x", "radial", "planar", "checker"})
    for (const char* modifiers :
         {" turbulence 0.5", " turbulence <0.5, 0.2, 0.8> octaves 3 lambda 2.5 omega 0.25 noise_generator 1",
          " warp { turbulence 0.5 }", " warp { turbulence <0.1, 0.4, 0> octaves 2 }"})
      if (std::string_view(kind) != "checker" ||
          std::string_view(modifiers).find("generator") == std::string_view::npos)
        patterns.push_back(std::string(kind) + modifiers);
  expect_same(patterns, 1e-5);
}

// A plane in the light of one lamp, so that each pixel is the cosine of its normal.
TEST_F(PovrayNoise, OfNormals) {
  const Vector3d to_lamp = normalize(Vector3d{0.3, 0.2, -1});
  for (const char* pattern :
       {"bumps", "dents", "wrinkles", "ripples", "waves", "ripples frequency 2 phase 0.3",
        "waves frequency 2 phase 0.3", "bumps turbulence 0.3"}) {
    SCOPED_TRACE(pattern);
    folder_.write("scene.pov",
                  fmt::format("#version 3.7; global_settings {{ assumed_gamma 1 }}\n"
                              "camera {{ orthographic location -z direction z right 4*x up 3*y }}\n"
                              "light_source {{ <0.3, 0.2, -1>*1e7 rgb 1 parallel point_at 0 }}\n"
                              "plane {{ z, 0 pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 1 }}\n"
                              "  normal {{ {} bump_size 0.5 translate <0.3, 0.2, 0.7> }} }}\n",
                              pattern));
    const std::string command =
        fmt::format("cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA -A +FP16 +Oout.ppm > log.txt 2>&1",
                    folder_.path().string(), width, height);
    ASSERT_EQ(std::system(command.c_str()), 0);
    const PovPicture theirs = read_ppm(folder_ / "out.ppm");
    const Scene scene = read_povray(folder_ / "scene.pov").scene;
    const PatternTexture* t = nullptr;
    for (const Texture& texture : scene.textures)
      if (const auto* found = std::get_if<PatternTexture>(&texture.model)) t = found;
    ASSERT_NE(t, nullptr);
    double apart = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Point3d p{(x + .5) / width * 4 - 2, 1.5 - (y + .5) / height * 3, 0};
        const Vector3d push = push_of_pattern(*t, transform_point(inverse(t->texture_to_world), p)) * 0.5;
        const double ours = std::max(dot(normalize(tilted_normal(*t, {0, 0, -1}, push)), to_lamp), 0.0);
        apart = std::max(apart, std::abs(ours - srgb_decode(theirs.at(x, y)[0])));
      }
    EXPECT_LT(apart, 2e-3);
  }
}

// Which generator patterns have that say none: by the version where the file ends, however often it changes.
TEST_F(PovrayNoise, GeneratorByVersion) {
  const std::string settings = "global_settings { assumed_gamma 1 } ";
  const std::string view = "camera { orthographic location -z direction z right 8*x up 6*y } ";
  const auto plane = [](const std::string& modifiers) {
    return "plane { z, 0 pigment { bozo " + modifiers +
           " color_map { [0 rgb 0] [1 rgb 1] } } finish { ambient 1 diffuse 0 } } ";
  };
  const std::vector<std::pair<std::string, NoiseGenerator>> scenes{
      {settings + view + plane(""), NoiseGenerator::corrected},
      {"#version 3.7; " + settings + view + plane(""), NoiseGenerator::corrected},
      {"#version 3.1; " + settings + view + plane(""), NoiseGenerator::original},
      {"#version 3.1; " + settings + view + plane("") + "#version 3.7;", NoiseGenerator::corrected},
      {"#version 3.7; " + settings + view + plane("") + "#version 3.1;", NoiseGenerator::original},
      {"#version 3.1; #include \"colors.inc\" " + settings + view + plane(""), NoiseGenerator::original},
      {"#version 3.7; global_settings { assumed_gamma 1 noise_generator 1 } " + view + plane(""),
       NoiseGenerator::original},
      {"#version 3.1; global_settings { assumed_gamma 1 noise_generator 2 } " + view + plane(""),
       NoiseGenerator::corrected},
      {"#version 3.1; " + settings + view + plane("noise_generator 2"), NoiseGenerator::corrected},
  };
  for (const auto& [text, generator] : scenes) {
    SCOPED_TRACE(text);
    const PovPicture theirs = PovrayPictures::by_povray(text);
    const Scene scene = read_povray(folder_ / "scene.pov").scene;
    const auto& t = std::get<PatternTexture>(scene.textures.at(0).model);
    EXPECT_EQ(t.noise, generator);
    double apart = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Point3d p{(x + .5) / width * 8 - 4, 3 - (y + .5) / height * 6, 0};
        apart += std::abs(pattern_value(t, p) - theirs.at(x, y)[0]) / (width * height);
      }
    EXPECT_LT(apart, 0.005);
  }
}

}  // namespace
}  // namespace vitrail::povray_noise_test
