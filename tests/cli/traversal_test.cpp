// SPDX-License-Identifier: Apache-2.0
// `render --traversal embree`: the same film, of one domain and of several, with instances and quadrics.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::traversal_test {
namespace {

constexpr const char* scene = R"(LookAt 0 3 9  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Sampler "independent" "integer pixelsamples" 8
Film "rgb" "integer xresolution" 48 "integer yresolution" 32
WorldBegin
LightSource "infinite" "rgb L" [.4 .5 .6]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [20 18 15]
  Translate 0 5 0
  Shape "disk" "float radius" 1
AttributeEnd
Material "diffuse" "rgb reflectance" [.7 .6 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-6 -1 -6 6 -1 -6 6 -1 6 -6 -1 6]
Shape "loopsubdiv" "integer levels" 5
  "integer indices" [0 2 1 0 3 2 0 1 3 1 2 3] "point3 P" [0 2 0 -2 -1 -1 2 -1 -1 0 -1 2]
ObjectBegin "pair"
  Shape "sphere" "float radius" .5
  Shape "loopsubdiv" "integer levels" 3
    "integer indices" [0 2 1 0 3 2 0 1 3 1 2 3] "point3 P" [0 1.5 0 -.6 .4 -.3 .6 .4 -.3 0 .4 .6]
ObjectEnd
AttributeBegin
  Translate -3 -.4 1
  ObjectInstance "pair"
  Translate 6 0 0
  ObjectInstance "pair"
AttributeEnd
)";

TEST(Traversal, ByEmbreeMakesTheSameFilm) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return (directory / name).string(); };
  std::ofstream(directory / "a.pbrt") << scene;
  for (const int domains : {1, 6}) {
    const std::string bundle = path(fmt::format("{}.vt", domains));
    ASSERT_EQ(run(fmt::format("{} {} -o {} --domains {} --quiet", vitrail("partition"), path("a.pbrt"),
                              bundle, domains))
                  .status,
              0);
    std::string hash[2];
    for (const bool by_embree : {false, true}) {
      const std::string stats = path(fmt::format("{}-{}.json", domains, by_embree));
      const CommandResult result =
          run(fmt::format("LD_DEBUG=bindings {} {} -o {} --force --quiet --stats {} --traversal {}",
                          vitrail("render"), bundle, path("a.film"), stats, by_embree ? "embree" : "own"));
      ASSERT_EQ(result.status, 0);
      // A function is bound when it is called first.
      EXPECT_EQ(result.output.find("`rtcCommitScene'") != std::string::npos, by_embree);
      hash[by_embree] = read_json(stats).at("film_hash");
    }
    EXPECT_EQ(hash[0], hash[1]) << domains << " domains";
  }
}

}  // namespace
}  // namespace vitrail::test::traversal_test
