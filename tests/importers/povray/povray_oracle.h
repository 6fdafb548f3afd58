// SPDX-License-Identifier: Apache-2.0
// Tests that hold written scenes to POV-Ray itself, where it is installed.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/importers/povray/povray_render.h"

namespace vitrail {

class PovrayOracle : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  }

  // `expected(x, y)` is the radiance at a point of the plane z = 0, in one channel or three.
  template <class Expected>
  void expect_plane(const Scene& scene, Expected&& expected, double tolerance = 0.005) {
    const PovPicture picture = render_povray(scene, folder_);
    ASSERT_FALSE(picture.values.empty());
    for (const int x : {2, 9, 16, 24, 30})
      for (const int y : {1, 12, 17, 29}) {
        const std::array<double, 3> seen = picture.at(x, y), wanted = expected(plane_x(x), plane_y(y));
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(seen[c], wanted[c], tolerance * wanted[c] + 2e-5) << x << ' ' << y << ' ' << c;
      }
  }

  // The colours at the middles of the four quarters: upper left, upper right, lower left, lower right.
  std::vector<std::array<double, 3>> quarters(const Scene& scene) {
    const PovPicture picture = render_povray(scene, folder_);
    if (picture.values.empty()) return {};
    const int w = picture.width, h = picture.height;
    return {picture.at(w / 4, h / 4), picture.at(3 * w / 4, h / 4), picture.at(w / 4, 3 * h / 4),
            picture.at(3 * w / 4, 3 * h / 4)};
  }

  TemporaryFolder folder_;
};

using Colors = std::vector<std::array<double, 3>>;
inline const std::array<double, 3> black{0, 0, 0}, red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1},
    white{1, 1, 1};

inline Scene plane(RGB reflectance = {.8, .5, .25}) {
  Scene scene = empty_povray_scene();
  add(scene, square(-5, 5, -5, 5, 0), diffuse(reflectance));
  return scene;
}

}  // namespace vitrail
