// SPDX-License-Identifier: Apache-2.0
// Near and far planes of cameras: kept where they cut something away, and written back to the bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::mitsuba_clip_test {
namespace {

constexpr ClipRange none;
constexpr float infinite = none.far;
constexpr const char* looks_down = "<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/>";

std::string text_of(const std::string& planes, const std::string& kind = "perspective",
                    const std::string& to_world = looks_down,
                    const std::string& shape = "<shape type='rectangle'><bsdf type='diffuse'/></shape>") {
  return "<scene version='3.0.0'><integrator type='volpath'/><sensor type='" + kind + "'>" + planes +
         "<transform name='to_world'>" + to_world +
         "</transform><film type='hdrfilm'><rfilter type='box'/></film></sensor><emitter type='constant'/>" +
         shape + "</scene>";
}

ImportedScene read(const std::string& text) {
  const TemporaryFolder folder;
  return read_mitsuba(folder.write("clip.xml", text));
}

template <class... More>
ClipRange clip(const std::string& planes, const More&... more) {
  const ImportedScene imported = read(text_of(planes, more...));
  EXPECT_TRUE(imported.diagnostics.empty());
  return clip_of(imported.scene.camera);
}

const std::string near_6 = "<float name='near_clip' value='6'/>",
                  far_4 = "<float name='far_clip' value='4'/>",
                  wide = "<float name='near_clip' value='0.5'/><float name='far_clip' value='100'/>";

TEST(MitsubaClipping, IsKeptWhereItCuts) {
  EXPECT_EQ(clip(""), none);
  EXPECT_EQ(clip(wide), none);
  EXPECT_EQ(clip(near_6), (ClipRange{6, infinite}));
  EXPECT_EQ(clip(far_4), (ClipRange{0, 4}));
}

TEST(MitsubaClipping, OfQuadrics) {
  const std::string ball = "<shape type='sphere'><bsdf type='diffuse'/></shape>";
  EXPECT_EQ(clip(wide, "perspective", looks_down, ball), none);
  EXPECT_EQ(clip(near_6, "perspective", looks_down, ball), (ClipRange{6, infinite}));
  EXPECT_EQ(clip("<float name='near_clip' value='4.5'/>", "perspective", looks_down, ball),
            (ClipRange{4.5f, infinite}));
  EXPECT_EQ(clip("<float name='far_clip' value='5.5'/>", "perspective", looks_down, ball),
            (ClipRange{0, 5.5f}));
}

// Mitsuba has planes where none are given: .01 and 10⁴.
TEST(MitsubaClipping, ItsOwnPlanesCutToo) {
  const std::string small = "<lookat origin='0,0,.005' target='0,0,0' up='0,1,0'/>";
  EXPECT_EQ(clip("", "perspective", small), (ClipRange{.01f, infinite}));
  const std::string huge =
      "<shape type='rectangle'><transform name='to_world'><scale value='20000'/>"
      "<translate z='-20000'/></transform><bsdf type='diffuse'/></shape>";
  EXPECT_EQ(clip("", "perspective", looks_down, huge), (ClipRange{0, 1e4f}));
}

// A floor under the camera is nearer than the plane, but not in the picture there.
TEST(MitsubaClipping, OnlyWhatIsInThePictureCounts) {
  const std::string floor =
      "<shape type='rectangle'><transform name='to_world'><scale value='100'/>"
      "<rotate x='1' angle='-90'/><translate y='-1'/></transform></shape>";
  EXPECT_EQ(clip("", "perspective", looks_down, floor), none);
  EXPECT_EQ(clip("<float name='near_clip' value='2'/>", "perspective", looks_down, floor), none);
  EXPECT_EQ(clip("<float name='near_clip' value='4'/>", "perspective", looks_down, floor),
            (ClipRange{4, infinite}));
}

TEST(MitsubaClipping, OfInstances) {
  const std::string two =
      "<shape type='shapegroup' id='g'><shape type='rectangle'/></shape>"
      "<shape type='instance'><ref id='g'/></shape><shape type='instance'><ref id='g'/>"
      "<transform name='to_world'><translate z='-3'/></transform></shape>";
  EXPECT_EQ(clip(wide, "perspective", looks_down, two), none);
  EXPECT_EQ(clip("<float name='far_clip' value='7'/>", "perspective", looks_down, two), (ClipRange{0, 7}));
}

// The near plane is in the scaled space of the camera; from there it is as far to the other as in the world.
TEST(MitsubaClipping, OfScaledOrthographicCameras) {
  const std::string planes = "<float name='near_clip' value='1'/><float name='far_clip' value='4'/>";
  EXPECT_EQ(clip(planes, "orthographic"), (ClipRange{0, 4}));
  EXPECT_EQ(clip(planes, "orthographic", std::string("<scale value='2'/>") + looks_down), none);
  EXPECT_EQ(clip("<float name='near_clip' value='1'/><float name='far_clip' value='3.5'/>", "orthographic",
                 std::string("<scale value='2'/>") + looks_down),
            (ClipRange{0, 2.25f}));
}

TEST(MitsubaClipping, TheNearPlaneShortensTheWayThroughTheCamerasMedium) {
  const std::string fog = "<medium type='homogeneous'/>";
  EXPECT_EQ(clip(fog + wide), (ClipRange{.5f, infinite}));
}

TEST(MitsubaClipping, RefusesWhatMitsubaRefuses) {
  EXPECT_THROW(clip("<float name='near_clip' value='0'/>"), Error);
  EXPECT_THROW(clip("<float name='near_clip' value='5'/><float name='far_clip' value='4'/>"), Error);
}

TEST(MitsubaClipping, IsWrittenBackToTheBit) {
  const std::string planes = "<float name='near_clip' value='4.7'/><float name='far_clip' value='5.3'/>";
  const std::string shapes =
      "<shape type='sphere'/><shape type='sphere'><point name='center' x='0' y='0' "
      "z='-1'/></shape>";
  for (const char* kind : {"perspective", "orthographic"})
    for (const std::string& to_world :
         {std::string(looks_down), std::string("<scale value='1.7'/>") + looks_down}) {
      if (kind == std::string("perspective") && to_world != looks_down) continue;
      const TemporaryFolder folder;
      const Scene first = read(text_of(planes, kind, to_world, shapes)).scene;
      ASSERT_NE(clip_of(first.camera), none) << kind << to_world;
      write_mitsuba(first, folder.path() / "out.xml");
      const Scene again = read_mitsuba(folder.path() / "out.xml").scene;
      EXPECT_FLOAT_EQ(clip_of(again.camera).near, clip_of(first.camera).near) << kind << to_world;
      EXPECT_FLOAT_EQ(clip_of(again.camera).far, clip_of(first.camera).far) << kind << to_world;
    }
}

}  // namespace
}  // namespace vitrail::mitsuba_clip_test
