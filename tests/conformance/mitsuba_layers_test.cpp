// SPDX-License-Identifier: Apache-2.0
// The layers of first surfaces that a Mitsuba scene asks for, pixel by pixel, against those of Mitsuba's own
// integrator `aov`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "film/develop.h"
#include "film/film_progress.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::mitsuba_layers_test {
namespace {

constexpr int width = 48, height = 36, grid = 24;

// A waving cloth over [−1.5, 1.5]², its front up, with the normals and (u,v) of the waves.
void write_cloth(const std::filesystem::path& file) {
  std::ofstream out(file);
  std::string text;
  for (int y = 0; y <= grid; ++y)
    for (int x = 0; x <= grid; ++x) {
      const double u = double(x) / grid, v = double(y) / grid, px = 3 * u - 1.5, py = 3 * v - 1.5;
      const double dx = 0.6 * std::cos(3 * px) * std::sin(2 * py),
                   dy = 0.4 * std::sin(3 * px) * std::cos(2 * py);
      const double l = std::sqrt(1 + dx * dx + dy * dy);
      text += fmt::format("v {} {} {}\nvt {} {}\nvn {} {} {}\n", px, py,
                          0.2 * std::sin(3 * px) * std::sin(2 * py), u, v, -dx / l, -dy / l, 1 / l);
    }
  for (int y = 0; y < grid; ++y)
    for (int x = 0; x < grid; ++x) {
      const int a = y * (grid + 1) + x + 1, b = a + 1, c = b + grid + 1, d = a + grid + 1;
      text += fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\nf {0}/{0}/{0} {2}/{2}/{2} {3}/{3}/{3}\n", a,
                          b, c, d);
    }
  out << text;
}

// Turned about one axis after the other: Mitsuba takes the transpose of a rotation for its inverse, also
// where its axis is not of length 1 and the matrix no rotation, and its normals are then beside the faces.
constexpr const char* scene_text = R"(<scene version="3.0.0">
  <integrator type="aov">
    <string name="aovs" value="albedo:albedo,ns:sh_normal,n:geo_normal,d.y:depth,p:position,t:uv"/>
    <integrator type="path"><integer name="max_depth" value="2"/></integrator>
  </integrator>
  <sensor type="perspective">
    <float name="fov" value="35"/>
    <float name="near_clip" value="0.0001"/>
    <transform name="to_world"><lookat origin="1.5,-5,5" target="0,0.2,0.2" up="0,0,1"/></transform>
    <film type="hdrfilm">
      <integer name="width" value="48"/><integer name="height" value="36"/>
      <string name="pixel_format" value="rgb"/><rfilter type="box"/>
    </film>
  </sensor>
  <emitter type="constant"/>
  <shape type="obj">
    <string name="filename" value="cloth.obj"/>
    <transform name="to_world"><rotate z="1" angle="25"/><scale x="1" y="1.2" z="0.8"/><translate x="100" y="0" z="0"/>
      <translate x="-100" y="0" z="0"/></transform>
    <bsdf type="diffuse"><texture name="reflectance" type="checkerboard">
      <rgb name="color0" value="0.8,0.2,0.1"/><rgb name="color1" value="0.1,0.4,0.7"/>
      <transform name="to_uv"><scale x="3" y="2"/></transform>
    </texture></bsdf>
  </shape>
  <shape type="cube">
    <transform name="to_world"><scale value="0.35"/><rotate x="1" angle="40"/><rotate y="1" angle="25"/><translate x="0.3" y="-0.4" z="0.9"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.3,0.6,0.9"/></bsdf>
  </shape>
</scene>)";

TEST(MitsubaLayers, AreOurs) {
  if (mitsuba_python().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  const TemporaryDirectory directory;
  write_cloth(directory / "cloth.obj");
  std::ofstream(directory / "scene.xml") << scene_text;
  const std::string scene = (directory / "scene.xml").string();
  const CommandResult theirs =
      run(fmt::format("{} '{}/tests/conformance/mitsuba_layers.py' '{}' '{}' --spp 64 --seeds 16",
                      mitsuba_python(), source_dir(), scene, (directory / "mitsuba.json").string()));
  ASSERT_EQ(theirs.status, 0) << theirs.output;
  const nlohmann::json expected = read_json(directory / "mitsuba.json");
  const CommandResult ours = run(fmt::format("{} '{}' -o '{}' --spp 1024", vitrail("render"), scene,
                                             (directory / "ours.film").string()));
  ASSERT_EQ(ours.status, 0) << ours.output;
  const Picture picture = develop(read_film(directory / "ours.film", nullptr));

  constexpr std::array<std::pair<const char*, const char*>, 15> pairs{{{"Albedo.R", "albedo.R"},
                                                                       {"Albedo.G", "albedo.G"},
                                                                       {"Albedo.B", "albedo.B"},
                                                                       {"P.X", "p.X"},
                                                                       {"P.Y", "p.Y"},
                                                                       {"P.Z", "p.Z"},
                                                                       {"N.X", "n.X"},
                                                                       {"N.Y", "n.Y"},
                                                                       {"N.Z", "n.Z"},
                                                                       {"Ns.X", "ns.X"},
                                                                       {"Ns.Y", "ns.Y"},
                                                                       {"Ns.Z", "ns.Z"},
                                                                       {"u", "t.U"},
                                                                       {"v", "t.V"},
                                                                       {"Z", "d.y.T"}}};
  ASSERT_EQ(picture.layers.size(), pairs.size());
  for (const auto& [ours_name, theirs_name] : pairs) {
    const auto layer = std::ranges::find(picture.layers, ours_name, &PictureChannel::name);
    ASSERT_NE(layer, picture.layers.end()) << ours_name;
    const nlohmann::json& reference = expected.at(theirs_name);
    // Beside noise: normals' codes, colours' spectra, and Mitsuba's near plane and floats; and what no more
    // than 4 of 1024 samples see behind an edge, of which those of the other side, and their error, may know
    // nothing.
    const auto [least, most] = std::ranges::minmax(reference["mean"].get<std::vector<double>>());
    const double slack = 2e-3 + (most - least) * 4 / 1024;
    double squares = 0, greatest = 0;
    int noisy = 0;
    for (std::size_t p = 0; p < width * height; ++p) {
      const double mean = reference["mean"][p], error = reference["error"][p];
      const double difference = std::abs(static_cast<double>(layer->values[p]) - mean);
      EXPECT_LE(difference, 8 * error + slack) << ours_name << " of pixel " << p % width << ", " << p / width;
      if (error > 2e-3) squares += difference * difference / (error * error), ++noisy;
      greatest = std::max(greatest, difference - 8 * error);
    }
    const double rms = noisy > 0 ? std::sqrt(squares / noisy) : 0;
    fmt::print("{}: rms z {:.2f} of {} pixels, beyond 8σ by {:.1e} at most\n", ours_name, rms, noisy,
               greatest);
    if (noisy > 20) {
      EXPECT_LE(rms, 1.5) << ours_name;
    }
  }
}

}  // namespace
}  // namespace vitrail::test::mitsuba_layers_test
