// SPDX-License-Identifier: Apache-2.0
// What <animation> of Mitsuba 0.6 moves.
#include "tests/importers/mitsuba/mitsuba_load.h"

namespace vitrail::mitsuba_motion_test {
namespace {

const std::string animation =
    "<animation name=\"toWorld\"><transform time=\"2\"><translate x=\"4\"/></transform>"
    "<transform time=\"0\"><translate x=\"1\"/></transform></animation>";
std::string camera_of(const std::string& inside) {
  return "<sensor type=\"perspective\">" + inside + "</sensor>";
}
const std::string open_shutter =
    "<float name=\"shutterOpen\" value=\"1\"/><float name=\"shutterClose\" value=\"2\"/>";

class MitsubaMotion : public MitsubaLoad {
 protected:
  const Scene& read_old(const std::string& inside) {
    imported_ = read_mitsuba(folder_.write("scene.xml", "<scene version=\"0.6.0\">" + inside + "</scene>"));
    return imported_.scene;
  }
  const std::vector<Keyframe> keys_{{0, translate({1, 0, 0})}, {2, translate({4, 0, 0})}};
};

TEST_F(MitsubaMotion, Cameras) {
  const Scene& scene = read_old(camera_of(open_shutter + animation));
  EXPECT_TRUE(imported_.diagnostics.empty());
  EXPECT_EQ(scene.shutter, (Shutter{1, 2}));
  std::vector<Keyframe> keys = keys_;
  for (Keyframe& key : keys) key.transform = key.transform * scale({-1, 1, 1});
  EXPECT_EQ(scene.camera_motion.keys(), keys);
  EXPECT_EQ(transform_point(std::get<PerspectiveCamera>(scene.camera).camera_to_world, {}),
            (Point3d{2.5, 0, 0}));
}

TEST_F(MitsubaMotion, ShapesAndInstances) {
  const std::string group = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\"/></shape>",
                    of_group = "<shape type=\"instance\"><ref id=\"g\"/>" + animation + "</shape>";
  const Scene& scene = read_old(camera_of(open_shutter) + group + of_group +
                                "<shape type=\"sphere\"><float name=\"radius\" value=\"2\"/>" + animation +
                                "<emitter type=\"area\"/></shape>");
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_TRUE(scene.shapes.empty());
  for (const Instance& instance : scene.instances) {
    ASSERT_TRUE(instance.motion);
    EXPECT_EQ(scene.motions[instance.motion->value].keys(), keys_);
    EXPECT_EQ(instance.prototype_to_world, translate({2.5, 0, 0}));
  }
  const Shape& ball = scene.prototypes[scene.instances[1].prototype.value].shapes.at(0);
  EXPECT_EQ(ball.object_to_world, scale({2, 2, 2}));
  EXPECT_FALSE(ball.area_light);
  EXPECT_TRUE(mentions("emitters in shape groups"));
}

// 0.6's shutter is open for no time if nothing is said.
TEST_F(MitsubaMotion, AClosedShutterSeesNoMotion) {
  const Scene& scene = read_old(camera_of(animation) + "<shape type=\"cube\">" + animation + "</shape>");
  EXPECT_TRUE(imported_.diagnostics.empty());
  EXPECT_FALSE(scene.camera_motion.moves());
  EXPECT_TRUE(scene.motions.empty());
  EXPECT_EQ(scene.shapes.at(0).object_to_world, translate({1, 0, 0}));
}

TEST_F(MitsubaMotion, WhatIsHeldIsReported) {
  read_old(camera_of(open_shutter) + "<emitter type=\"point\">" + animation + "</emitter>");
  EXPECT_TRUE(mentions("motion of an emitter"));
  const std::string mirrored =
      "<animation name=\"toWorld\"><transform time=\"2\"><scale x=\"-1\"/></transform>"
      "<transform time=\"0\"/></animation>";
  const Scene& scene = read_old(camera_of(open_shutter) + "<shape type=\"cube\">" + mirrored + "</shape>");
  EXPECT_TRUE(mentions("of which one mirrors"));
  EXPECT_EQ(scene.shapes.size(), 1u);
}

TEST_F(MitsubaMotion, Mistakes) {
  const auto in_cube = [&](const std::string& inside) {
    return error_inside("<shape type=\"cube\"><animation name=\"to_world\">" + inside +
                        "</animation></shape>");
  };
  EXPECT_THAT(in_cube(""), testing::HasSubstr("needs a <transform"));
  EXPECT_THAT(in_cube("<float/>"), testing::HasSubstr("alone, not <float>"));
  EXPECT_THAT(in_cube("<transform/>"), testing::HasSubstr("needs an attribute \"time\""));
  EXPECT_THAT(in_cube("<transform time=\"1\"/><transform time=\"1\"/>"),
              testing::HasSubstr("have the time 1"));
  EXPECT_THAT(error_inside(camera_of("<float name=\"shutter_open\" value=\"1\"/>")),
              testing::HasSubstr("closes before"));
}

}  // namespace
}  // namespace vitrail::mitsuba_motion_test
