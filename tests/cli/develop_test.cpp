// SPDX-License-Identifier: Apache-2.0
// What develop makes of films and pictures, as a user types it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "film/film_progress.h"
#include "film/image_io.h"
#include "film/picture_extent.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::develop_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Develop : public ::testing::Test {
 protected:
  // 40 × 20 pixels of a Cornell box.
  CommandResult render(const std::string& out, const std::string& more) const {
    return run(
        fmt::format("{} {}/examples/cornell-box/cornell-box.pbrt --width 40 --height 20 --quiet -o {} {}",
                    vitrail("render"), source_dir(), path(out), more));
  }
  CommandResult develop(const std::string& in, const std::string& out, const std::string& more = "") const {
    return run(fmt::format("{} {} -o {} {}", vitrail("develop"), in, path(out), more));
  }
  std::string path(const std::string& name) const { return "'" + (directory_ / name).string() + "'"; }
  Picture picture(const std::string& name) const { return read_picture(directory_ / name); }
  Film film(const std::string& name) const { return read_film(directory_ / name, nullptr); }
  TemporaryDirectory directory_;
};

TEST_F(Develop, SaysInOneLineWhatItWrote) {
  ASSERT_EQ(render("a.film", "--spp 2").status, 0);
  const CommandResult done = develop(path("a.film"), "a.png", "--exposure -0.5 --tone agx");
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output, AllOf(HasSubstr("a.png: 40 × 20 pixels of 8 bits, 2 samples each"),
                                 HasSubstr("exposure -0.50, tone agx\n")));
  EXPECT_EQ(develop(path("a.film"), "a.png", "--quiet").output, "");
}

TEST_F(Develop, MergesMoreFilmsThanTheShellLetsOpen) {
  std::string films;
  for (int seed = 1; seed <= 12; ++seed) {
    const std::string name = fmt::format("{}.film", seed);
    ASSERT_EQ(render(name, fmt::format("--spp 1 --seed {}", seed)).status, 0);
    films += path(name) + " ";
  }
  const CommandResult done =
      run(fmt::format("ulimit -S -n 12; {} {} -o {}", vitrail("develop"), films, path("all.png")));
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("12 samples each"));
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// It is made row by row of films that stay in their files; the bytes are those of the whole picture.
TEST_F(Develop, WritesAnExrAsOfTheWholeFilm) {
  std::vector<Film> films;
  for (const int seed : {1, 2}) {
    const std::string name = fmt::format("{}.film", seed);
    ASSERT_EQ(render(name, fmt::format("--spp 2 --spectral 5 --aov cryptomatte,albedo,shape_index --alpha "
                                       "--light-groups --crop 3,37,1,19 --seed {}",
                                       seed))
                  .status,
              0);
    films.push_back(film(name));
    write_film(directory_ / name, films.back(), {});  // without words on the scene, which develop adds
  }
  const auto expect_same = [&](Picture whole, const std::string& of, const std::string& more) {
    write_picture(directory_ / "whole.exr", whole);
    ASSERT_EQ(develop(of, "rows.exr", "--layers all " + more).status, 0);
    EXPECT_EQ(bytes_of(directory_ / "rows.exr"), bytes_of(directory_ / "whole.exr")) << more;
  };
  Picture one = vitrail::develop(films[0]);
  expect_same(one, path("1.film"), "");
  expose(one, 1.5);
  expect_same(one, path("1.film"), "--exposure 1.5");
  cut_to(one, {5, 30, 2, 18});
  expect_same(one, path("1.film"), "--exposure 1.5 --crop 5,30,2,18");
  films[0].merge(films[1]);
  Picture both = vitrail::develop(films[0]);
  both.origin.seeds = "1,2";
  expect_same(both, path("2.film") + " " + path("1.film"), "");
}

// A picture goes on where its film left off, layers and origin included.
TEST_F(Develop, ReadsPicturesToo) {
  ASSERT_EQ(render("a.film", "--spp 2 --aov albedo,normal,depth").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.exr", "--variance").status, 0);
  ASSERT_EQ(develop(path("a.exr"), "b.exr", "--variance").status, 0);
  EXPECT_EQ(run("cmp " + path("a.exr") + " " + path("b.exr")).status, 0);
  ASSERT_EQ(develop(path("a.film"), "film.png", "--exposure 1").status, 0);
  ASSERT_EQ(develop(path("a.exr"), "exr.png", "--exposure 1").status, 0);
  EXPECT_EQ(run("cmp " + path("film.png") + " " + path("exr.png")).status, 0);
  EXPECT_EQ(develop(path("a.exr") + " " + path("b.exr"), "c.png").status, 2);
  EXPECT_EQ(develop(path("a.exr"), "c.film").status, 2);
  EXPECT_EQ(develop(path("a.exr"), "c.exr", "--spectral").status, 3);
}

TEST_F(Develop, WritesOtherFormats) {
  ASSERT_EQ(render("a.film", "--spp 2").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.exr").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.hdr").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.png").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.webp").status, 0);
  const Image exact = picture("a.exr").rgb, hdr = picture("a.hdr").rgb, png = picture("a.png").rgb,
              webp = picture("a.webp").rgb;
  double webp_error = 0;
  for (std::size_t i = 0; i < exact.values.size(); ++i) {
    const std::size_t pixel = i / 3 * 3;
    const float greatest =
        std::max({exact.values[pixel], exact.values[pixel + 1], exact.values[pixel + 2], 0.0f});
    EXPECT_NEAR(hdr.values[i], std::max(exact.values[i], 0.0f), greatest / 100);  // 8 bits of the greatest
    webp_error += static_cast<double>(std::abs(webp.values[i] - png.values[i]));
  }
  EXPECT_LT(webp_error / static_cast<double>(exact.values.size()), 0.05);
  EXPECT_EQ(develop(path("a.film"), "b.hdr", "--tone agx").status, 2);
  EXPECT_EQ(develop(path("a.film"), "b.webp", "--bits 16").status, 2);
}

TEST_F(Develop, CutsAndResizes) {
  ASSERT_EQ(render("a.film", "--spp 2 --aov albedo").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.exr").status, 0);
  ASSERT_EQ(develop(path("a.film"), "part.exr", "--crop 10,30,0,10").status, 0);
  const Picture whole = picture("a.exr"), part = picture("part.exr");
  EXPECT_EQ(part.window, (PixelRect{10, 30, 0, 10}));
  EXPECT_EQ(part.full_width, 40);
  EXPECT_EQ(part.rgb.values[0], whole.rgb.values[30]);
  for (const auto& [size, width, height] :
       {std::tuple("20x5", 20, 5), {"80", 80, 40}, {"50%", 20, 10}, {"1", 1, 1}}) {
    ASSERT_EQ(develop(path("a.film"), "b.exr", fmt::format("--resize {}", size)).status, 0) << size;
    EXPECT_EQ(picture("b.exr").rgb.width, width) << size;
    EXPECT_EQ(picture("b.exr").rgb.height, height) << size;
  }
  for (const char* wrong : {"--resize 0", "--resize 4x", "--resize 5%%", "--resize -3", "--crop 10,41,0,10",
                            "--crop 5,5,0,10", "--resize 50% --variance"})
    EXPECT_EQ(develop(path("a.film"), "c.exr", wrong).status, 2) << wrong;
}

TEST_F(Develop, ShowsLayers) {
  ASSERT_EQ(render("a.film", "--spp 2 --aov albedo,depth,shape_index").status, 0);
  ASSERT_EQ(develop(path("a.film"), "depth.exr", "--layer depth").status, 0);
  const Film f = film("a.film");
  EXPECT_EQ(picture("depth.exr").rgb.values[3 * 407],
            static_cast<float>(f.mean_of_layer(407, Layer::depth, 0)));
  EXPECT_EQ(develop(path("a.film"), "ids.png", "--layer shape_index").status, 0);
  const CommandResult none = develop(path("a.film"), "b.png", "--layer normal");
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.output, HasSubstr("no layer sh_normal; there is albedo, depth, shape_index"));
  EXPECT_EQ(develop(path("a.film"), "b.png", "--layer albedo --tone agx").status, 2);
}

TEST_F(Develop, ExposesByThePicture) {
  ASSERT_EQ(render("a.film", "--spp 16").status, 0);
  ASSERT_EQ(develop(path("a.film"), "a.hdr", "--exposure auto").status, 0);
  ASSERT_EQ(develop(path("a.hdr"), "b.exr", "--exposure auto").status, 0);
  const CommandResult again = develop(path("b.exr"), "c.exr", "--exposure auto");
  EXPECT_THAT(again.output, ::testing::ContainsRegex("exposure [+-]0\\.0[01]|samples each\n"));
  EXPECT_EQ(develop(path("a.film"), "a.png", "--exposure bright").status, 2);
  EXPECT_EQ(develop(path("a.film"), "a.png", "--false-color auto --exposure auto").status, 2);
}

TEST_F(Develop, MergesFilmsIntoOne) {
  for (const int seed : {0, 1, 2})
    ASSERT_EQ(render(fmt::format("{}.film", seed), fmt::format("--spp 4 --seed {}", seed)).status, 0);
  ASSERT_EQ(develop(path("0.film") + " " + path("1.film"), "01.film").status, 0);
  ASSERT_EQ(develop(path("2.film") + " " + path("01.film"), "all.exr").status, 0);
  ASSERT_EQ(develop(path("0.film") + " " + path("1.film") + " " + path("2.film"), "three.exr").status, 0);
  EXPECT_EQ(picture("all.exr").rgb, picture("three.exr").rgb);
  EXPECT_EQ(picture("all.exr").origin.seeds, "0,1,2");
  EXPECT_EQ(picture("all.exr").samples_per_pixel, 12);
  EXPECT_THAT(run(vitrail("inspect") + " " + path("01.film")).output, HasSubstr("seeds: 0 1\n"));
  const CommandResult twice = develop(path("01.film") + " " + path("1.film"), "b.exr");
  EXPECT_EQ(twice.status, 3);
  EXPECT_THAT(twice.output, HasSubstr("it has seed 1"));
  EXPECT_EQ(develop(path("2.film"), "01.film").status, 3) << "it holds other work";
  const CommandResult resumed = render("01.film", "--spp 8");
  EXPECT_EQ(resumed.status, 3) << resumed.output;
  ASSERT_EQ(render("deep.film", "--spp 4 --seed 3 --max-depth 2").status, 0);
  const CommandResult other = develop(path("0.film") + " " + path("deep.film"), "b.film");
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.output, HasSubstr("their depths differ"));
  for (const char* option : {"--exposure 1", "--variance", "--bits 8", "--crop 0,1,0,1"})
    EXPECT_EQ(develop(path("0.film"), "b.film", option).status, 2) << option;
}

}  // namespace
}  // namespace vitrail::test::develop_test
