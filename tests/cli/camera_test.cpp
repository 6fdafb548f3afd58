// SPDX-License-Identifier: Apache-2.0
// `render --camera FILE`, as it is typed: the camera of another scene.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::camera_test {
namespace {

using ::testing::HasSubstr;

class CameraTyped : public ::testing::Test {
 protected:
  CameraTyped() {
    scene("a.pbrt", "LookAt 3 1 4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40", 24, 16);
    scene("b.pbrt", "LookAt -1 2 5  .2 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 55", 24, 16);
  }
  void scene(const std::string& name, const std::string& camera, int width, int height) const {
    std::ofstream(directory_ / name) << fmt::format(
        "{}\nFilm \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\nWorldBegin\n"
        "LightSource \"infinite\" \"rgb L\" [.3 .4 .5]\nShape \"sphere\"\nTranslate 1 .5 0\n"
        "Material \"diffuse\" \"rgb reflectance\" [.8 .2 .1]\nShape \"sphere\" \"float radius\" .5\n",
        camera, width, height);
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  Film render(const std::string& in, const std::string& more, int ranks = 1) const {
    const CommandResult done =
        run(fmt::format("{} {} -o {} --spp 16 --force --quiet {}", vitrail_on(ranks, "render"), path(in),
                        path("out.film"), more));
    EXPECT_EQ(done.status, 0) << done.output;
    return read_film(directory_ / "out.film", nullptr);
  }
  static void expect_same_picture(const Film& a, const Film& b) {
    ASSERT_EQ(a.pixels(), b.pixels());
    for (std::uint32_t p = 0; p < a.pixels(); ++p) ASSERT_EQ(a.mean(p), b.mean(p)) << p;
  }

  TemporaryDirectory directory_;
};

TEST_F(CameraTyped, OfAnotherSceneSeesAsThatOne) {
  const Film expected = render("b.pbrt", "");
  const Film seen = render("a.pbrt", "--camera " + path("b.pbrt"));
  expect_same_picture(seen, expected);
  EXPECT_NE(seen.key().scene_hash, render("a.pbrt", "").key().scene_hash) << "it is another picture";
  // Of another format, and on the ranks of a job.
  ASSERT_EQ(run(fmt::format("{} {} -o {} --quiet", vitrail("convert"), path("b.pbrt"), path("b.xml"))).status,
            0);
  expect_same_picture(render("a.pbrt", "--camera " + path("b.xml")), expected);
  EXPECT_EQ(render("a.pbrt", "--camera " + path("b.pbrt"), 3).hash(), seen.hash());
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out.tmp.camera"));
}

// A film of other proportions: all that it saw is seen, and more on one axis. `--width` alone does the same.
TEST_F(CameraTyped, FitsTheFilm) {
  scene("wide.pbrt", "LookAt 3 1 4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40", 48, 16);
  expect_same_picture(render("a.pbrt", "--camera " + path("wide.pbrt") + " --width 48 --height 16"),
                      render("a.pbrt", "--width 48 --height 16"));
}

TEST_F(CameraTyped, MovesAsItDoesThere) {
  scene("moving.pbrt",
        "ActiveTransform StartTime\nLookAt 3 1 4  0 0 0  0 1 0\nActiveTransform EndTime\n"
        "LookAt 3 1.5 4  0 .5 0  0 1 0\nActiveTransform All\nCamera \"perspective\" \"float fov\" 40",
        24, 16);
  expect_same_picture(render("a.pbrt", "--camera " + path("moving.pbrt")), render("moving.pbrt", ""));
  expect_same_picture(render("moving.pbrt", "--camera " + path("a.pbrt")), render("a.pbrt", ""));
}

TEST_F(CameraTyped, IsOfFramesToo) {
  ASSERT_EQ(
      run(fmt::format("{} {} -o {} --quiet", vitrail("partition"), path("a.pbrt"), path("a.vit"))).status, 0);
  std::ofstream(directory_ / "frames.txt") << "\n--camera " << path("b.pbrt") << "\n--fov 40\n";
  const CommandResult done = run(fmt::format("{} {} --frames {} -o {} --spp 16 --quiet", vitrail("render"),
                                             path("a.vit"), path("frames.txt"), path("f%d.film")));
  ASSERT_EQ(done.status, 0) << done.output;
  expect_same_picture(read_film(directory_ / "f1.film", nullptr), render("b.pbrt", ""));
}

TEST_F(CameraTyped, ThatIsNotThereIsRefused) {
  const CommandResult none = run(fmt::format("{} {} -o {} --camera {} --quiet", vitrail("render"),
                                             path("a.pbrt"), path("c.film"), path("none.pbrt")));
  EXPECT_EQ(none.status, 3) << none.output;
  EXPECT_THAT(none.output, HasSubstr("none.pbrt"));
}

}  // namespace
}  // namespace vitrail::test::camera_test
