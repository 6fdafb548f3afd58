// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_long_lists_test {
namespace {

// Lists of more than 4096 numbers are kept narrower and read in pieces.
class LongLists : public testing::Test {
 protected:
  static constexpr int count = 2000;  // of vertices, and of triangles all but two

  // A fan about vertex 0, `shift` from the origin.
  static std::string mesh(double shift = 0, const std::string& last_index = "1",
                          const std::string& last_normal = "1") {
    std::string p, n, uv, indices;
    for (int i = 0; i < count; ++i) {
      const double phi = 3.0 * i / count, r = i == 0 ? 0 : 1;
      p += fmt::format("{:.9f}  {:.9f}\t{:.9f} # comment\n", shift + r * std::cos(phi), r * std::sin(phi),
                       shift);
      n += fmt::format("0 {} {}\n", i * 0.5, i + 1 == count ? last_normal : "1e0");
      uv += fmt::format("{} -{}\r\n", i, i);
      if (i >= 2) indices += fmt::format("0 {} {}\n", i - 1, i + 1 == count ? last_index : std::to_string(i));
    }
    return "Shape \"trianglemesh\" \"normal N\" [" + n + "] \"integer indices\" [" + indices +
           "] \"point2 uv\" [" + uv + "]\n\"point3 P\" [" + p + "]\n";
  }

  static std::string message_of(const std::string& world) {
    try {
      import_v4(world);
    } catch (const Error& error) {
      EXPECT_GE(error.location.line, 3);
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(LongLists, AreReadWhole) {
  const ImportedScene imported = import_v4(mesh());
  expect_no_diagnostics(imported);
  const TriangleMesh& read = imported.scene.meshes.at(0);
  ASSERT_EQ(read.positions.size(), std::size_t{count});
  ASSERT_EQ(read.triangles.size(), std::size_t{count - 2});
  EXPECT_EQ(read.positions[1500].x, static_cast<float>(std::round(std::cos(2.25) * 1e9) / 1e9));
  EXPECT_EQ(read.normals[1500], (Normal3f{0, 750, 1}));
  EXPECT_EQ(read.uvs[1999], (Point2f{1999, -1999}));
  EXPECT_EQ(read.triangles[1000], (std::array<std::uint32_t, 3>{0, 1001, 1002}));
}

TEST_F(LongLists, FarAwayKeepTheirDetail) {
  const Scene near = import_v4(mesh()).scene, far = import_v4(mesh(1e7)).scene;
  const Transform& place = far.shapes.at(0).object_to_world;
  for (std::size_t i = 0; i < count; i += 100) {
    const Point3d p = transform_point(place, cast<double>(far.meshes[0].positions[i]));
    EXPECT_NEAR(p.x - 1e7, near.meshes[0].positions[i].x, 1e-7);
  }
}

TEST_F(LongLists, OfDefaultsServeEveryShape) {
  const std::string p_begin = "\"point3 P\" [", text = mesh();
  const std::string positions = text.substr(text.find(p_begin));
  const std::string rest = text.substr(0, text.find(p_begin));
  const Scene scene = import_v4("Attribute \"shape\" " + positions + rest + "\n" + rest).scene;
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0], scene.meshes[1]);
  EXPECT_EQ(scene.meshes[0], import_v4(text).scene.meshes[0]);
}

TEST_F(LongLists, AreChecked) {
  EXPECT_THAT(message_of(mesh(0, "2000")), testing::HasSubstr("value 5993 of parameter \"indices\" is 2000"));
  EXPECT_THAT(message_of(mesh(0, "-1")), testing::HasSubstr("is -1, but there are 2000 vertices"));
  EXPECT_THAT(message_of(mesh(0, "3000000000")), testing::HasSubstr("out of range"));
  EXPECT_THAT(message_of(mesh(0, "1", "1e39")),
              testing::HasSubstr("value 5999 of parameter \"N\" is too large"));
  EXPECT_THAT(message_of(mesh(0, "1", "")), testing::HasSubstr("not a multiple of 3"));
  EXPECT_TRUE(mentions(import_v4(mesh(0, "1.5")).diagnostics, "fractions are cut off"));
}

}  // namespace
}  // namespace vitrail::pbrt_long_lists_test
