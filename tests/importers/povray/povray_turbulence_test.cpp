// SPDX-License-Identifier: Apache-2.0
// Patterns under turbulence have the statistics of povray's pixels, if not the pixels: mean, deviation, and
// the mean step from pixel to pixel, over 64 × 48 units.
#include "scene/models/pattern.h"
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_turbulence_test {
namespace {

constexpr int columns = 256, rows = 192;
constexpr double units_a_pixel = 1.0 / 4;

struct Statistics {
  double mean = 0, deviation = 0, step = 0;
};

template <class Value>
Statistics statistics(Value&& value) {
  Statistics s;
  double squares = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double v = value(x, y);
      s.mean += v, squares += v * v;
      if (x + 1 < columns) s.step += std::abs(value(x + 1, y) - v) / 2;
      if (y + 1 < rows) s.step += std::abs(value(x, y + 1) - v) / 2;
    }
  constexpr double pixels = columns * rows;
  s.mean /= pixels, s.step /= pixels;
  s.deviation = std::sqrt(squares / pixels - s.mean * s.mean);
  return s;
}

// Grey levels for the patterns that have a list, from black to white.
std::string list_of(const std::string& pattern) {
  const int places = pattern == "checker" || pattern == "brick"      ? 2
                     : pattern == "hexagon"                          ? 3
                     : pattern == "square"                           ? 4
                     : pattern == "triangular" || pattern == "cubic" ? 6
                                                                     : 0;
  std::string list;
  for (int i = 0; i < places; ++i) list += fmt::format(" rgb {}", static_cast<double>(i) / (places - 1));
  return list;
}

class PovrayTurbulence : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_povray()) GTEST_SKIP() << "povray is not installed: nothing was rendered";
  }

  Statistics by_povray() {
    const std::string command =
        fmt::format("cd '{}' && povray +Iscene.pov +W{} +H{} -D -GA -A +FP16 +Oout.ppm > log.txt 2>&1",
                    folder_.path().string(), columns, rows);
    EXPECT_EQ(std::system(command.c_str()), 0);
    const PovPicture picture = read_ppm(folder_ / "out.ppm");
    if (picture.values.empty()) return {};
    return statistics([&](int x, int y) { return srgb_decode(picture.at(x, y)[0]); });
  }

  Statistics by_vitrail(double units) {
    const Scene scene = read_povray(folder_ / "scene.pov").scene;
    for (const Texture& texture : scene.textures)
      if (const auto* const pattern = std::get_if<PatternTexture>(&texture.model)) {
        const Transform to_texture = inverse(pattern->texture_to_world);
        std::vector<double> values;
        for (int y = 0; y < rows; ++y)
          for (int x = 0; x < columns; ++x) {
            const Point3d at{(x + .5 - columns / 2) * units, (rows / 2 - y - .5) * units, 0};
            const PatternMix mix = pattern_mix(*pattern, transform_point(to_texture, at));
            const auto first = static_cast<double>(mix.first), second = static_cast<double>(mix.second);
            values.push_back(((1 - mix.amount) * first + mix.amount * second) /
                             static_cast<double>(pattern->map.size() - 1));
          }
        return statistics([&](int x, int y) { return values[static_cast<std::size_t>(y * columns + x)]; });
      }
    ADD_FAILURE() << "no pattern";
    return {};
  }

  void expect_alike(const std::string& pattern, const std::string& modifiers) {
    SCOPED_TRACE(pattern + " " + modifiers);
    // Smooth noise has few bumps in a small part of a plane: its deviation would be another in each.
    const bool is_smooth =
        pattern == "bozo" || pattern == "bumps" || pattern == "dents" || pattern == "wrinkles";
    const double units = units_a_pixel * (is_smooth ? 5 : 1);
    folder_.write("scene.pov",
                  fmt::format("#version 3.7; global_settings {{ assumed_gamma 1 }}\n"
                              "camera {{ orthographic location -15*z look_at 0 right {}*x up {}*y }}\n"
                              "plane {{ z, 0 pigment {{ {} {} {} rotate <37, 52, 11> }} "
                              "finish {{ ambient 1 diffuse 0 }} }}\n",
                              columns * units, rows * units, pattern + list_of(pattern), modifiers,
                              list_of(pattern).empty() ? "color_map { [0 rgb 0] [1 rgb 1] }" : ""));
    const Statistics theirs = by_povray(), ours = by_vitrail(units);
    fmt::print("{:10} {:28} {:.4f} {:.4f}  {:.4f} {:.4f}  {:.4f} {:.4f}\n", pattern, modifiers, theirs.mean,
               ours.mean, theirs.deviation, ours.deviation, theirs.step, ours.step);
    constexpr double may = .05;
    EXPECT_NEAR(ours.mean, theirs.mean, may * theirs.mean);
    EXPECT_NEAR(ours.deviation, theirs.deviation, may * theirs.deviation);
    EXPECT_NEAR(ours.step, theirs.step, may * theirs.step);
  }

  TemporaryFolder folder_;
};

// Bumps are bozo, and dents its cube.
TEST_F(PovrayTurbulence, StatisticsOfPatterns) {
  for (const char* pattern :
       {"agate", "bozo", "bumps", "cells", "crackle", "dents", "granite", "leopard", "marble", "onion",
        "ripples", "spiral1 3", "waves", "wood", "wrinkles", "gradient x"})
    for (const char* modifiers : {"", "turbulence .5"}) expect_alike(pattern, modifiers);
  if (!std::getenv("VITRAIL_LONG_TESTS")) return;
  for (const char* pattern :
       {"radial", "spiral2 3", "square", "triangular", "cubic", "checker", "brick", "hexagon"})
    for (const char* modifiers : {"", "turbulence .5"}) expect_alike(pattern, modifiers);
}

TEST_F(PovrayTurbulence, WarpsAndOtherAmounts) {
  for (const char* pattern : {"agate", "wood", "marble", "spiral1 3"})
    for (const char* modifiers : {"warp { turbulence .5 }", "turbulence 1"}) expect_alike(pattern, modifiers);
  expect_alike("agate", "turbulence <.5, .2, .8>");
}

// Of all others povray shows the same bits by a warp.
TEST(PovrayWarps, OfMostPatternsAreTurbulence) {
  const TemporaryFolder folder;
  const auto shown = [&](const std::string& pigment) {
    folder.write("scene.pov", "#version 3.7; plane { z, 0 pigment { " + pigment + " } }");
    const Scene scene = read_povray(folder / "scene.pov").scene;
    return std::get<PatternTexture>(scene.textures.at(0).model);
  };
  for (const std::string pattern :
       {"bozo", "bumps", "cells", "crackle", "dents", "granite", "leopard", "onion", "ripples", "waves",
        "wrinkles", "gradient x", "radial", "spiral2 3", "checker", "brick", "hexagon"})
    EXPECT_EQ(shown(pattern + " turbulence .5"), shown(pattern + " warp { turbulence .5 }")) << pattern;
}

}  // namespace
}  // namespace vitrail::povray_turbulence_test
