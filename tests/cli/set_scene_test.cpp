// SPDX-License-Identifier: Apache-2.0
// `render --set`, --look-at and --fov on a bundle: to the bit the picture of a bundle that is made of the
// scene edited in that way.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::set_scene_test {
namespace {

using ::testing::HasSubstr;

struct Values {
  std::string lamp = "1", point = "1", color = ".5 .4 .3", roughness = ".2", fov = "60";
};

std::string pbrt_scene(const Values& v) {
  return fmt::format(R"(LookAt 0 -3 2  0 0 0  0 0 1
Camera "perspective" "float fov" {}
Sampler "independent" "integer pixelsamples" 4
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
WorldBegin
LightSource "point" "point3 from" [1 0 2] "rgb I" [2 3 4] "float scale" {}
LightSource "infinite" "rgb L" [.1 .2 .3]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [4 3 2] "float scale" {}
  Shape "trianglemesh" "point3 P" [-1 1 1 -1 -1 1 -1 0 2] "integer indices" [0 1 2]
AttributeEnd
MakeNamedMaterial "floor" "string type" "diffuse" "rgb reflectance" [{}]
NamedMaterial "floor"
Shape "trianglemesh" "point3 P" [-2 -2 0 2 -2 0 2 2 0 -2 2 0] "integer indices" [0 1 2 0 2 3]
MakeNamedMaterial "metal" "string type" "conductor" "float roughness" {} "bool remaproughness" false
NamedMaterial "metal"
Translate 0 0 .5
Shape "sphere" "float radius" .4
)",
                     v.fov, v.point, v.lamp, v.color, v.roughness);
}

struct View {
  std::string origin = "0, -4, 2", turbidity = "3", sun = "0.3, 0.2, 0.8";
};

std::string mitsuba_scene(const View& v) {
  return fmt::format(R"(<scene version="3.0.0">
<integrator type="path"/>
<sensor type="perspective"><float name="fov" value="40"/>
  <transform name="to_world"><lookat origin="{}" target="0, 0, 0.3" up="0, 0, 1"/></transform>
  <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film>
  <sampler type="independent"><integer name="sample_count" value="4"/></sampler></sensor>
<emitter type="sunsky"><float name="turbidity" value="{}"/><vector name="sun_direction" value="{}"/></emitter>
<shape type="rectangle"/><shape type="sphere"><float name="radius" value="0.4"/></shape>
</scene>
)",
                     v.origin, v.turbidity, v.sun);
}

class SetScene : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string bundle(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
    const CommandResult made =
        run(fmt::format("{} {} -o {}.vit --force --quiet", vitrail("partition"), path(name), path(name)));
    EXPECT_EQ(made.status, 0) << made.output;
    return path(name) + ".vit";
  }
  std::string hash(const std::string& bundle, const std::string& options = "") const {
    const std::string film = path("picture.film");
    const CommandResult made =
        run(fmt::format("{} {} -o {} --force --quiet {}", vitrail("render"), bundle, film, options));
    EXPECT_EQ(made.status, 0) << made.output;
    return hash_of(film);
  }
  static std::string hash_of(const std::string& film) {
    const CommandResult told = run(fmt::format("{} --json {}", vitrail("inspect"), film));
    return nlohmann::json::parse(told.output).at("film_hash").get<std::string>();
  }
  void expect_refused(const std::string& bundle, const std::string& options, const std::string& words) const {
    const CommandResult refused =
        run(fmt::format("{} {} -o {} --force {}", vitrail("render"), bundle, path("no.film"), options));
    EXPECT_EQ(refused.status, 2) << options;
    EXPECT_THAT(refused.output, HasSubstr(words)) << options;
  }

  TemporaryDirectory directory_;
};

TEST_F(SetScene, LightsAndMaterialsAndTheAngleOfView) {
  const std::string plain = bundle("plain.pbrt", pbrt_scene({}));
  const std::string before = hash(plain);
  const auto expect_edit = [&](const char* options, const Values& edited) {
    const std::string set = hash(plain, options);
    EXPECT_EQ(set, hash(bundle("edited.pbrt", pbrt_scene(edited)))) << options;
    EXPECT_NE(set, before) << options;
  };
  expect_edit("--set point-2.scale=4", {.point = "4"});
  expect_edit("--set area-1.scale=.25", {.lamp = ".25"});
  expect_edit("--set floor.color=.1:.7:.2", {.color = ".1 .7 .2"});
  expect_edit("--set metal.roughness=.4", {.roughness = ".4"});
  expect_edit("--fov 30", {.fov = "30"});
  expect_edit("--set metal.roughness=.1 --set area-1.scale=2 --fov 45",
              {.lamp = "2", .roughness = ".1", .fov = "45"});
}

// By the names of objects, of the material, and by number.
TEST_F(SetScene, LampsOfAnObj) {
  const std::string obj =
      "mtllib lamps.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 .2\nv 1 1 0\nv 2 1 1\no Desk lamp\nusemtl Glow\nf 1 2 3\n"
      "o Floor.001\nusemtl Wood\nf 2 3 4\no Ceiling\nusemtl Glow\nf 3 4 5\n";
  const auto library = [&](const char* glow) {
    std::ofstream(directory_ / "lamps.mtl") << "newmtl Glow\nKe " << glow << "\nnewmtl Wood\nKd .5 .4 .3\n";
  };
  library("2 2 2");
  const std::string bright = bundle("bright.obj", obj);
  library("4 4 4");
  const std::string twice = hash(bundle("twice.obj", obj), "--width 32 --height 24 --spp 2");
  const auto set = [&](const std::string& options) {
    return hash(bright, "--width 32 --height 24 --spp 2 " + options);
  };
  EXPECT_NE(set(""), twice);
  EXPECT_EQ(set("--set Glow.scale=2"), twice);
  EXPECT_EQ(set("--set Desk_lamp.scale=2 --set Ceiling.scale=2"), twice);
  EXPECT_EQ(set("--set 'Desk lamp.scale=2' --set area-2.scale=2"), twice);
  EXPECT_NE(set("--set Ceiling.scale=2"), twice);
  expect_refused(bright, "--set Cieling.scale=2", "there is Ceiling, Desk_lamp; did you mean Ceiling?");
  expect_refused(bright, "--set Cieling.scale=2", "vitrail inspect lists all");
  expect_refused(bright, "--set Wood.scale=2", "this is a material that does not shine");
  expect_refused(bright, "--set Ceiling.color=1:0:0", "this is a light, and no material has this name");
}

TEST_F(SetScene, SkyAndPlaceOfTheCamera) {
  const std::string plain = bundle("plain.xml", mitsuba_scene({}));
  const std::string before = hash(plain);
  const auto expect_edit = [&](const char* options, const View& edited) {
    const std::string set = hash(plain, options);
    EXPECT_EQ(set, hash(bundle("edited.xml", mitsuba_scene(edited)))) << options;
    EXPECT_NE(set, before) << options;
  };
  expect_edit("--set sky-1.turbidity=6", {.turbidity = "6"});
  expect_edit("--set sky-1.sun=-.5:.1:.6", {.sun = "-.5, .1, .6"});
  expect_edit("--look-at 3,-2,1,0,0,.3,0,0,1", {.origin = "3, -2, 1"});
}

// Of a bundle under another sky.
TEST_F(SetScene, AnotherSkyIsThatOfABundleMadeUnderIt) {
  const std::string plain = bundle("plain.xml", mitsuba_scene({})), before = hash(plain);
  for (const char* words :
       {"48.86,2.35,2026-06-21T12:00+02:00,turbidity=5", "48.86,2.35,2026-06-21T12:00+02:00,cie=3",
        "48.86,2.35,2026-06-21T12:00+02:00,direct=300W,diffuse=250W,sun=0.5"}) {
    const CommandResult made =
        run(fmt::format("{} {} -o {} --force --quiet --sky {},up=z,north=y", vitrail("partition"),
                        path("plain.xml"), path("other.vit"), words));
    ASSERT_EQ(made.status, 0) << made.output;
    const std::string set = hash(plain, fmt::format("--set sky-1.sky={}", words));
    EXPECT_EQ(set, hash(path("other.vit"))) << words;
    EXPECT_NE(set, before) << words;
  }
  expect_refused(plain, "--set sky-1.sky=48.86,2.35", "--sky takes LATITUDE");
  expect_refused(plain, "--set sky-1.sky=48.86,2.35,2026-06-21T12:00Z,up=y", "knows which of its axes");
  expect_refused(bundle("plain.pbrt", pbrt_scene({})), "--set point-2.sky=48.86,2.35,2026-06-21T12:00Z",
                 "a light has a scale");
}

// `--sky` is the edit of the one sky, in the command and in a line of frames.
TEST_F(SetScene, SkyOfTheCommandIsThatOfSet) {
  const std::string plain = bundle("plain.xml", mitsuba_scene({}));
  const std::string noon = "48.86,2.35,2026-06-21T12:00+02:00,turbidity=5",
                    dull = "48.86,2.35,2026-06-21T12:00+02:00,cie=3";
  const std::string set = hash(plain, "--set sky-1.sky=" + noon);
  EXPECT_NE(set, hash(plain));
  EXPECT_EQ(hash(plain, "--sky " + noon), set);
  EXPECT_EQ(hash(plain, "--sky " + noon + " --set sky-1.sun=.1:.2:.9"),
            hash(plain, "--set sky-1.sky=" + noon + " --set sky-1.sun=.1:.2:.9"));

  std::ofstream(directory_ / "frames.txt") << "--seed 0\n--sky " << dull << "\n";
  const CommandResult frames = run(fmt::format("{} {} --frames {} -o {} --sky {} --quiet", vitrail("render"),
                                               plain, path("frames.txt"), path("%04d.film"), noon));
  ASSERT_EQ(frames.status, 0) << frames.output;
  EXPECT_EQ(hash_of(path("0001.film")), set);
  EXPECT_EQ(hash_of(path("0002.film")), hash(plain, "--set sky-1.sky=" + dull));

  expect_refused(plain, "--sky 48.86,2.35", "--sky takes LATITUDE");
  for (const char* axis : {"up=z", "north=y"})
    expect_refused(plain, fmt::format("--sky {},{}", noon, axis), "knows which of its axes");
  expect_refused(bundle("lamps.pbrt", pbrt_scene({})), "--sky " + noon, "the bundle has no sky");
  std::string two = mitsuba_scene({});
  two.insert(two.find("<shape"), "<emitter type=\"sunsky\"/>");
  expect_refused(bundle("two.xml", two), "--sky " + noon,
                 "2 skies: give --set NAME.sky= to one of sky-1, sky-2");
}

// A scene with a lamp of each kind, and the same without any of them.
std::string daylit_scene(bool with_lamps) {
  const auto lamp = [&](const char* text) { return with_lamps ? text : ""; };
  std::string scene = R"(LookAt 0 -3 2  0 0 0  0 0 1
Camera "perspective" "float fov" 60
Sampler "independent" "integer pixelsamples" 16
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [.1 .2 .3]
LightSource "distant" "point3 from" [1 1 3] "point3 to" [0 0 0] "rgb L" [.5 .5 .4]
)";
  scene += lamp("LightSource \"point\" \"point3 from\" [1 0 2] \"rgb I\" [2 3 4] \"float power\" 20\n");
  scene += lamp("LightSource \"spot\" \"point3 from\" [-1 0 2] \"point3 to\" [0 0 0] \"rgb I\" [9 3 4]\n");
  scene += fmt::format(R"(MakeNamedMedium "fire" "string type" "homogeneous" "rgb sigma_a" [.3 .3 .3]
  "rgb sigma_s" [.2 .2 .2] {}
AttributeBegin
  Material "diffuse" "rgb reflectance" [.5 .5 .5]
  {} Translate -.8 0 .6
  Shape "sphere" "float radius" .3
AttributeEnd
AttributeBegin
  Material "interface"
  MediumInterface "fire" ""
  Translate .6 0 .5
  Shape "sphere" "float radius" .4
AttributeEnd
Material "diffuse" "rgb reflectance" [.5 .4 .3]
Shape "trianglemesh" "point3 P" [-3 -3 0  3 -3 0  3 3 0  -3 3 0] "integer indices" [0 1 2 0 2 3]
)",
                       lamp(R"("rgb Le" [2 1 .5])"), lamp(R"(AreaLightSource "diffuse" "rgb L" [4 3 2])"));
  return scene;
}

// The same picture, whether the lamps are off in the partition, in the render of a scene, or in a bundle.
TEST_F(SetScene, LampsOffLeaveDaylightAlone) {
  std::ofstream(directory_ / "lit.pbrt") << daylit_scene(true);
  const std::string dark = bundle("lit.pbrt", daylit_scene(true)),
                    plain = bundle("day.pbrt", daylit_scene(false));
  const CommandResult made = run(fmt::format("{} {} -o {} --force --lamps off", vitrail("partition"),
                                             path("lit.pbrt"), path("off.vit")));
  ASSERT_EQ(made.status, 0) << made.output;
  for (const char* what :
       {"a surface's light: --lamps off", "a lamp: --lamps off", "a medium's light: --lamps off"})
    EXPECT_THAT(made.output, HasSubstr(what));
  const std::string alone = hash(plain);
  EXPECT_NE(hash(dark), alone);
  EXPECT_EQ(hash(path("off.vit")), alone);
  const auto picture = [&](const std::string& scene, const std::string& options) {
    const CommandResult rendered = run(fmt::format("{} {} -o {} --force --spp 64 {}", vitrail("render"),
                                                   scene, path("picture.exr"), options));
    EXPECT_EQ(rendered.status, 0) << rendered.output;
    std::filesystem::copy_file(path("picture.exr"), path(options.empty() ? "day.exr" : "off.exr"),
                               std::filesystem::copy_options::overwrite_existing);
    return rendered.output;
  };
  picture(plain, "");
  const auto expect_same = [&](const std::string& scene, const char* words) {
    EXPECT_THAT(picture(scene, "--lamps off"), HasSubstr(words));
    const CommandResult compared =
        run(fmt::format("{} {} {} --fail-above 1e-12", vitrail("compare"), path("off.exr"), path("day.exr")));
    EXPECT_EQ(compared.status, 0) << scene << compared.output;
  };
  expect_same(path("lit.pbrt"), "a lamp: --lamps off");
  expect_same(path("off.vit"), "--lamps off: no light is off");
  expect_same(dark, "--lamps off: area-1, medium-1, point-");
}

// The camera that a mesh without one gets looks down; moved, its horizon is level, as z or y is up.
TEST_F(SetScene, ALevelCameraStaysLevel) {
  const std::string mesh = bundle("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 .2\nf 1 2 3\n");
  const std::string level = hash(mesh, "--width 32 --height 24 --spp 2 --look-at 2,.6,1,0,.2,0,0,1,0");
  EXPECT_EQ(hash(mesh, "--width 32 --height 24 --spp 2 --look-at 2,.6,1,0,.2,0"), level);
  EXPECT_NE(hash(mesh, "--width 32 --height 24 --spp 2 --look-at 2,.6,1,0,.2,0,0,1,.3"), level);
}

TEST_F(SetScene, WhatCannotBeIsRefused) {
  const std::string plain = bundle("plain.pbrt", pbrt_scene({}));
  expect_refused(plain, "--set lamp.scale=2", "there is area-1, infinite-3, point-2");
  expect_refused(plain, "--set wall.color=.1:.2:.3", "there is floor, metal");
  expect_refused(plain, "--set metal.color=.1:.2:.3", "no color");
  expect_refused(plain, "--set floor.roughness=.1", "no roughness");
  expect_refused(plain, "--set metal.roughness=0", "partition it again");
  expect_refused(plain, "--set point-2.sun=0:0:1", "a light has a scale");
  expect_refused(plain, "--set point-2.scale=-1", "not negative");
  expect_refused(plain, "--set point-2.scale=", "a scale is a number");
  expect_refused(plain, "--set floor.color=.1", "three numbers");
  expect_refused(plain, "--set floor.shine=1", "can be set");
  expect_refused(plain, "--look-at 0,0,0,0,0,0", "no direction");
  expect_refused(plain, "--look-at 0,0,1", "--look-at takes");
}

}  // namespace
}  // namespace vitrail::test::set_scene_test
