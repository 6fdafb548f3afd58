// SPDX-License-Identifier: Apache-2.0
// `render --aov cryptomatte`, as it is typed, and read by a reader that shares nothing with the writer.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::cryptomatte_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class CryptomatteTyped : public ::testing::Test {
 protected:
  // Three balls of two materials, one of them without a name, on nothing.
  CryptomatteTyped() {
    const auto ball = [](const char* id, double x, const char* bsdf) {
      return fmt::format(
          "<shape type='sphere'{}><float name='radius' value='.7'/><point name='center' x='{}' y='0' z='0'/>"
          "<ref id='{}'/></shape>",
          id, x, bsdf);
    };
    std::ofstream(directory_ / "a.xml")
        << "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'>"
           "<float name='fov' value='45'/><transform name='to_world'>"
           "<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'>"
           "<integer name='width' value='40'/><integer name='height' value='24'/></film></sensor>"
           "<emitter type='constant'/><bsdf type='diffuse' id='chalk'/>"
           "<bsdf type='conductor' id='gold &quot;24&quot;'/>"
        << ball(" id='left'", -1, "chalk") << ball(" id='middle'", 0, "gold &quot;24&quot;")
        << ball("", 1, "chalk") << "</scene>";
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  CommandResult render(const std::string& picture, const std::string& more) const {
    return run(fmt::format("{} {} -o {} --spp 32 --force --quiet {}", vitrail("render"), path("a.xml"),
                           path(picture), more));
  }
  Json masks(const std::string& picture) const {
    const CommandResult read =
        run(fmt::format("/usr/bin/python3 {}/tests/cli/read_cryptomatte.py {}", source_dir(), path(picture)));
    EXPECT_EQ(read.status, 0) << read.output;
    return Json::parse(read.output);
  }
  static double sum(const Json& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum;
  }

  TemporaryDirectory directory_;
};

TEST_F(CryptomatteTyped, MasksHaveNamesAndSumToAlpha) {
  for (const char* more : {"", "--splat", "--adaptive --spp 24"}) {
    ASSERT_EQ(render("a.exr", std::string("--alpha --aov cryptomatte,alpha ") + more).status, 0) << more;
    const Json read = masks("a.exr");
    const Json& objects = read.at("masks").at("CryptoObject");
    const Json& materials = read.at("masks").at("CryptoMaterial");
    ASSERT_TRUE(objects.contains("left") && objects.contains("middle")) << objects.dump();
    ASSERT_EQ(objects.size(), 3u) << "the third has the name of its number";
    ASSERT_EQ(materials.size(), 2u);
    const Json& alpha = read.at("channels").at("A");
    const std::string third = [&] {
      for (const auto& [name, values] : objects.items())
        if (name != "left" && name != "middle") return name;
      return std::string();
    }();
    EXPECT_EQ(third, "shape-3");
    for (std::size_t p = 0; p < alpha.size(); ++p) {
      double of_objects = 0, of_materials = 0;
      for (const Json& values : objects) of_objects += values[p].get<double>();
      for (const Json& values : materials) of_materials += values[p].get<double>();
      ASSERT_NEAR(of_objects, alpha[p], 1e-5) << more << " " << p;
      ASSERT_NEAR(of_materials, alpha[p], 1e-5) << more << " " << p;
      ASSERT_NEAR(materials.at("chalk")[p].get<double>(),
                  objects.at("left")[p].get<double>() + objects.at(third)[p].get<double>(), 1e-5);
    }
    // π·0.7² at a distance of about 5, where the picture is 2·5·tan 22.5° high of its shorter side … 3 balls.
    EXPECT_GT(sum(objects.at("middle")), 60) << more;
    EXPECT_NEAR(sum(objects.at("left")), sum(objects.at(third)), 0.05 * sum(objects.at("left"))) << more;
    EXPECT_NEAR(sum(materials.at("gold \"24\"")), sum(objects.at("middle")), 1e-3) << more;
  }
}

TEST_F(CryptomatteTyped, AreDevelopedCutAndShown) {
  ASSERT_EQ(render("a.film", "--aov cryptomatte,albedo --light-groups").status, 0);
  const auto develop = [&](const std::string& to, const std::string& more) {
    return run(fmt::format("{} {} -o {} {}", vitrail("develop"), path("a.film"), path(to), more));
  };
  ASSERT_EQ(develop("all.exr", "--layers all").status, 0);
  Json read = masks("all.exr");
  EXPECT_TRUE(read.at("channels").contains("Variance.Y"));
  EXPECT_TRUE(read.at("channels").contains("Albedo.R"));
  EXPECT_EQ(read.at("masks").size(), 2u);
  const double whole = sum(read.at("masks").at("CryptoObject").at("left"));
  ASSERT_EQ(develop("some.exr", "--layers crypto_object,groups").status, 0);
  read = masks("some.exr");
  EXPECT_EQ(read.at("masks").size(), 1u);
  EXPECT_FALSE(read.at("channels").contains("Albedo.R"));
  EXPECT_FALSE(read.at("channels").contains("Variance.Y"));
  EXPECT_THAT(read.at("channels").dump(), HasSubstr("Light."));
  ASSERT_EQ(develop("cut.exr", "--crop 0,20,0,24").status, 0);
  const double half = sum(masks("cut.exr").at("masks").at("CryptoObject").at("left"));
  EXPECT_TRUE(half == whole || half == 0) << "it is in one half of the picture";
  const CommandResult resized = develop("small.exr", "--resize 50%");
  EXPECT_THAT(resized.output, HasSubstr("ids do not mix"));
  EXPECT_EQ(masks("small.exr").at("masks").size(), 0u);
  EXPECT_EQ(develop("a.png", "--layer crypto_object").status, 0);
  const CommandResult none = develop("b.exr", "--layers depth");
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.output, HasSubstr("no layer depth"));
  EXPECT_EQ(develop("b.exr", "--layers nothing").status, 2);
  EXPECT_EQ(develop("b.png", "--layers all").status, 2);
}

TEST_F(CryptomatteTyped, ABundleHasToTellShapesApart) {
  const auto partition = [&](const std::string& to, const std::string& more) {
    return run(fmt::format("{} {} -o {} --quiet {}", vitrail("partition"), path("a.xml"), path(to), more));
  };
  ASSERT_EQ(partition("a.vit", "").status, 0);
  ASSERT_EQ(partition("b.vit", "--aov shape_index").status, 0);
  const auto render = [&](const std::string& bundle, const std::string& aov) {
    return run(fmt::format("{} {} -o {} --spp 1 --force --quiet --aov {}", vitrail("render"), path(bundle),
                           path("b.exr"), aov));
  };
  const CommandResult refused = render("a.vit", "cryptomatte");
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.output, HasSubstr("partition the scene with --aov crypto_object"));
  EXPECT_EQ(render("a.vit", "crypto_material").status, 0);
  EXPECT_EQ(render("b.vit", "cryptomatte").status, 0);
  EXPECT_EQ(run(vitrail("verify") + " " + path("b.vit")).status, 0);
  std::ofstream(directory_ / "b.vit/shapes.json", std::ios::app) << " ";
  EXPECT_EQ(run(vitrail("verify") + " " + path("b.vit")).status, 3);
  EXPECT_EQ(render("b.vit", "cryptomatte").status, 3);
}

// Of one material, one of them in two parts of the file.
TEST_F(CryptomatteTyped, ObjectsOfAnObjAreMasks) {
  const auto square = [](double x) {
    return fmt::format("v {0} 0 0\nv {1} 0 0\nv {1} 1 0\nv {0} 1 0\nf -4 -3 -2 -1\n", x, x + 1);
  };
  std::ofstream(directory_ / "a.obj") << "o chair\nusemtl oak\n"
                                      << square(0) << "o table\n"
                                      << square(1.2) << "o chair\n"
                                      << square(2.4);
  const CommandResult made =
      run(fmt::format("{} {} -o {} --aov cryptomatte --width 48 --height 32 --spp 4 --quiet",
                      vitrail("render"), path("a.obj"), path("o.exr")));
  ASSERT_EQ(made.status, 0) << made.output;
  const Json read = masks("o.exr");
  const Json& objects = read.at("masks").at("CryptoObject");
  ASSERT_EQ(objects.size(), 2u) << objects.dump();
  EXPECT_GT(sum(objects.at("table")), 30);
  EXPECT_NEAR(sum(objects.at("chair")), 2 * sum(objects.at("table")), .1 * sum(objects.at("chair")));
}

}  // namespace
}  // namespace vitrail::test::cryptomatte_test
