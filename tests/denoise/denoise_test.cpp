// SPDX-License-Identifier: Apache-2.0
// What needs no denoiser: where it is looked for, which guides it gets, and what is said where there is none.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "denoise/denoise_picture.h"
#include "denoise/oidn_library.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::denoise_test {
namespace {

using ::testing::HasSubstr;

TEST(OidnLibrary, IsFoundInPythonEnvironments) {
  const TemporaryDirectory environment;
  const std::filesystem::path folder = environment / "lib/python3.99/site-packages/pyoidn/oidn/lib";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "libOpenImageDenoise.so.2") << "no library";
  const char* own = std::getenv("VIRTUAL_ENV");
  const std::string before = own ? own : "";
  ::setenv("VIRTUAL_ENV", environment.path().c_str(), 1);
  const std::vector<std::filesystem::path> found = oidn::python_libraries();
  ::setenv("VIRTUAL_ENV", before.c_str(), 1);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front(), folder / "libOpenImageDenoise.so.2");
}

PictureChannel channel(const char* name, float value) { return {name, false, {value, value}, {}}; }

TEST(Guides, AreTheLayersThatThePictureHas) {
  Picture picture;
  picture.rgb = black_image(2, 1, 3);
  EXPECT_EQ(guides_of(picture).albedo.pixels(), 0u);
  for (const char* name : {"Albedo.B", "Albedo.G", "Albedo.R", "N.X", "N.Y", "N.Z"})
    picture.layers.push_back(channel(name, static_cast<float>(picture.layers.size())));
  EXPECT_EQ(guides_of(picture).albedo.values, (std::vector<float>{2, 1, 0, 2, 1, 0}));
  EXPECT_EQ(guides_of(picture).normals.values, (std::vector<float>{3, 4, 5, 3, 4, 5}));
  for (const char* name : {"Ns.X", "Ns.Y", "Ns.Z"}) picture.layers.push_back(channel(name, 7));
  EXPECT_EQ(guides_of(picture).normals.values, std::vector<float>(6, 7)) << "those of shading go first";
}

class WithoutDenoiser : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return "'" + (directory_ / name).string() + "'"; }
  CommandResult render(const std::string& more) const {
    return run(
        fmt::format("VITRAIL_OIDN=/nowhere {} {}/examples/cornell-box/cornell-box.pbrt --width 8 "
                    "--height 8 --spp 2 --quiet {}",
                    vitrail("render"), source_dir(), more));
  }
  TemporaryDirectory directory_;
};

TEST_F(WithoutDenoiser, ARenderSaysSoBeforeItBegins) {
  const CommandResult r = render("--denoise -o " + path("a.png"));
  EXPECT_EQ(r.status, 4) << r.output;
  EXPECT_THAT(r.output, HasSubstr("pip install pyoidn"));
  EXPECT_THAT(r.output, HasSubstr("VITRAIL_OIDN is /nowhere"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "a.film"));
}

TEST_F(WithoutDenoiser, WrongUseIsOne) {
  ASSERT_EQ(render("-o " + path("a.film")).status, 0);
  const auto develop = [&](const std::string& more) {
    return run("VITRAIL_OIDN=/nowhere " + vitrail("develop") + " " + path("a.film") + " --denoise " + more)
        .status;
  };
  EXPECT_EQ(develop("-o " + path("a.png")), 4);
  EXPECT_EQ(develop("-o " + path("a.csv")), 2);
  EXPECT_EQ(develop("-o " + path("a.exr") + " --variance"), 2);
  EXPECT_EQ(develop("-o " + path("a.png") + " --false-color auto"), 2);
  EXPECT_EQ(render("--denoise -o " + path("b.film")).status, 2);
}

}  // namespace
}  // namespace vitrail::test::denoise_test
