// SPDX-License-Identifier: Apache-2.0
// Small scenes as povray shows them, and as they are read and rendered here: the means of 8 × 8 blocks.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "film/develop.h"
#include "importers/povray/read/povray.h"
#include "scene/spectra/color.h"
#include "tests/importers/povray/povray_render.h"
#include "tests/support/render.h"

namespace vitrail {

class PovrayPictures : public testing::Test {
 protected:
  static constexpr int width = 64, height = 48;

  void SetUp() override {
    if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  }

  PovPicture by_povray(const std::string& text) {
    folder_.write("scene.pov", text);
    const std::string command = fmt::format(
        "cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA +A0.0 +AM1 +R4 +FP16 +Oout.ppm "
        "> log.txt 2>&1",
        folder_.path().string(), width, height);
    EXPECT_EQ(std::system(command.c_str()), 0) << text;
    PovPicture picture = read_ppm(folder_ / "out.ppm");
    for (double& v : picture.values) v = srgb_decode(v);  // as a screen shows it, whatever assumed_gamma is
    return picture;
  }
  std::vector<double> by_vitrail(int samples) {
    Scene scene = read_povray(folder_ / "scene.pov").scene;
    scene.film.width = width, scene.film.height = height, scene.film.crop = {0, width, 0, height};
    RenderOptions options;
    options.picture.samples_per_pixel = samples;
    options.picture.integrator = scene.settings.direct_only ? Integrator::direct : Integrator::path;
    const Picture picture = develop(test::render(scene, std::move(options)).film);
    std::vector<double> values(picture.rgb.values.begin(), picture.rgb.values.end());
    for (double& v : values) v = std::min(v, 1.0);  // as in files
    return values;
  }
  static std::vector<double> blocks(const std::vector<double>& values) {
    std::vector<double> means(width / 8 * (height / 8) * 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          means[static_cast<std::size_t>((y / 8 * (width / 8) + x / 8) * 3 + c)] +=
              values[static_cast<std::size_t>((y * width + x) * 3 + c)] / 64;
    return means;
  }
  static double difference(const std::vector<double>& theirs, const std::vector<double>& ours) {
    double difference = 0, all = 0;
    for (std::size_t i = 0; i < theirs.size(); ++i)
      difference += std::abs(theirs[i] - ours[i]), all += theirs[i];
    EXPECT_GT(all, 0);
    return difference / all;
  }
  // The mean difference of the blocks, over the mean of povray's picture. Noise only adds to it: what agrees
  // with a quarter of the samples agrees with all.
  void expect_alike(const std::string& text, double most, int samples = 32) {
    const PovPicture picture = by_povray(text);
    ASSERT_FALSE(picture.values.empty());
    const std::vector<double> theirs = blocks(picture.values);
    double off = difference(theirs, blocks(by_vitrail(samples / 4)));
    if (!(off < most)) off = difference(theirs, blocks(by_vitrail(samples)));
    fmt::print("{:.2f} %\n", 100 * off);
    EXPECT_LT(off, most) << text;
  }

  TemporaryFolder folder_;
};

inline const std::string raised_camera = "camera { location <0, 1.5, -4> look_at <0, 0.7, 0> }\n";
inline const std::string linear_view = "#version 3.7; global_settings { assumed_gamma 1 }\n" + raised_camera;
inline const std::string two_lamps =
    "light_source { <-3, 5, -4> rgb <.8, .7, .6> } light_source { <4, 3, -2> rgb <.2, .3, .4> }\n";

}  // namespace vitrail
