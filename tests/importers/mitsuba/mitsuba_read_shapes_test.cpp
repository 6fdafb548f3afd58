// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "images/image_files.h"
#include "importers/mitsuba/read/builder.h"
#include "importers/ply/read/ply.h"
#include "importers/writing/write_ply.h"
#include "scene/geometry/pi.h"
#include "scene/shapes/curve_meshes.h"
#include "scene/shapes/deferred_mesh.h"
#include "tests/importers/bytes_of_numbers.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::mitsuba::mitsuba_read_shapes_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Object shape(std::string type, std::vector<Property> properties = {}) {
  return {"shape", std::move(type), "", {0, 7, 3}, std::move(properties)};
}
Property nested(std::string tag, std::string type, std::string name = "") {
  return {std::move(name),
          std::make_shared<const Object>(Object{std::move(tag), std::move(type), "", {}, {}}),
          {}};
}

// A twosided bsdf around a diffuse one.
Property two_sided() {
  auto outer = std::make_shared<Object>();
  outer->tag = "bsdf";
  outer->type = "twosided";
  outer->properties.push_back(nested("bsdf", "diffuse"));
  return {"", ObjectPtr(outer), {}};
}
Property nested(Object object) { return {"", std::make_shared<const Object>(std::move(object)), {}}; }

// A Scene made of some shapes.
struct Reading {
  Scene scene;
  Report report{scene.files};
  Builder builder{scene, report, {}, {}, {}, {}, {}, {}};

  Reading() { scene.files = {"scene.xml"}; }
  Reading& add(const Object& object) {
    add_shape(builder, object);
    return *this;
  }
  const TriangleMesh& stored(std::size_t i = 0) const { return scene.meshes[scene.shapes[i].mesh.value]; }
  TriangleMesh mesh(std::size_t i = 0) const {
    TriangleMesh storage;
    return loaded(stored(i), storage);
  }
};

std::string error_of(const Object& object) {
  Reading reading;
  try {
    reading.add(object);
  } catch (const Error& error) {
    return fmt::format("{}: {}", to_string(error.location), error.what());
  }
  return "no error";
}

Vector3d area_vector(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const auto p = [&](std::size_t i) { return cast<double>(mesh.positions[t[i]]); };
  return cross(p(1) - p(0), p(2) - p(0)) * 0.5;
}

// Every triangle faces where the normals of its corners point.
void expect_fronts_follow_normals(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t)
      ASSERT_GT(dot(area_vector(mesh, t), to_vector(cast<double>(mesh.normals[corner]))), 0);
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += length(area_vector(mesh, t));
  return sum;
}

const Transform mirror = scale({-1, 1, 1});

TEST(MitsubaShapes, QuadricsAreKept) {
  Reading reading;
  reading.add(shape("sphere"))
      .add(shape("sphere", {{"radius", 2.0, {}}, {"center", Vector3d{1, 2, 3}, {}}}))
      .add(shape("disk"))
      .add(shape("cylinder", {{"radius", 0.5, {}}, {"p1", Vector3d{0, 0, 3}, {}}}));
  const auto quadric = [&](std::size_t i) {
    return reading.scene.meshes[reading.scene.shapes[i].mesh.value].quadric;
  };
  EXPECT_EQ(quadric(0), (Quadric{.kind = QuadricKind::sphere, .uv = QuadricUv::mitsuba}));
  EXPECT_EQ(quadric(2), (Quadric{.kind = QuadricKind::disk, .uv = QuadricUv::mitsuba, .low = 0}));
  EXPECT_EQ(quadric(3), (Quadric{.kind = QuadricKind::cylinder})) << "pbrt's (u,v) is Mitsuba's";
  EXPECT_EQ(reading.scene.shapes[1].object_to_world, translate({1, 2, 3}) * scale({2, 2, 2}));
  EXPECT_EQ(reading.scene.shapes[3].object_to_world, scale({0.5, 0.5, 3}));
  EXPECT_EQ(reading.scene.shapes[1].mesh, reading.scene.shapes[0].mesh) << "sizes are the transform's";
  EXPECT_EQ(reading.scene.meshes.size(), 3u);
  EXPECT_THAT(reading.report.take(), testing::IsEmpty());
}

// Mitsuba 3.9.1 shows a ball around to_world · centre, as wide as to_world · x is long.
TEST(MitsubaShapes, SpheresAreRoundWhateverStretchesThem) {
  Transform askew;
  askew.m = {{{1, .5, 0, 4}, {2, -1, .25, 5}, {.5, 0, 3, 6}, {0, 0, 0, 1}}};
  for (const Transform& to_world :
       {scale({3, 2, 1}), translate({1, 2, 3}) * rotate(1, {0, 0, 1}) * scale({-.5, .9, .3}), askew}) {
    Reading reading;
    reading.add(shape("sphere",
                      {{"radius", 2.0, {}}, {"center", Vector3d{1, 2, 3}, {}}, {"to_world", to_world, {}}}));
    const Transform& t = reading.scene.shapes.at(0).object_to_world;
    const double radius = 2 * length(transform_vector(to_world, {1, 0, 0}));
    EXPECT_LT(length(transform_point(t, {0, 0, 0}) - transform_point(to_world, {1, 2, 3})), 1e-12);
    const Vector3d axes[] = {transform_vector(t, {1, 0, 0}), transform_vector(t, {0, 1, 0}),
                             transform_vector(t, {0, 0, 1})};
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(length(axes[i]), radius, 1e-12);
      EXPECT_NEAR(dot(axes[i], axes[(i + 1) % 3]), 0, 1e-12);
    }
    EXPECT_EQ(swaps_handedness(t), swaps_handedness(to_world));
    EXPECT_THAT(reading.report.take(), ElementsAre(testing::Field(&Diagnostic::message, HasSubstr("round"))));
  }
  Reading turned;
  turned.add(shape("sphere", {{"to_world", rotate(1, {1, 2, 3}) * scale({2, 2, -2}), {}}}));
  EXPECT_THAT(turned.report.take(), testing::IsEmpty());
}

TEST(MitsubaShapes, AnalyticShapesFaceOutwards) {
  const std::pair<const char*, double> areas[] = {
      {"rectangle", 4}, {"cube", 24}, {"disk", pi}, {"sphere", 4 * pi}, {"cylinder", 2 * pi}};
  for (const auto& [type, expected] : areas) {
    const Reading reading = std::move(Reading().add(shape(type)));
    expect_fronts_follow_normals(reading.mesh());
    EXPECT_NEAR(area(reading.mesh()), expected, 2e-4 * expected) << type;
    EXPECT_FALSE(reading.scene.shapes[0].flip_orientation) << type;
    const Material& material = reading.scene.materials[0];
    EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(material.model) && !material.two_sided);
  }
}

// The (u,v) that Mitsuba 3.9 gives at points of its shapes.
TEST(MitsubaShapes, AnalyticShapesHaveMitsubasTextureCoordinates) {
  struct Case {
    Object object;
    Point3d point;
    Point2d uv;
  };
  const Case cases[] = {
      {shape("rectangle"), {0.5, 0.2, 0}, {0.75, 0.6}},
      {shape("cube"), {0.5, 0.2, 1}, {0.6, 0.75}},
      {shape("disk"), {0.2, 0.5, 0}, {0.5385, 0.1894}},
      {shape("disk"), {0.2, -0.5, 0}, {0.5385, 0.8106}},
      {shape("sphere", {{"radius", 2.0, {}}}), {0.5, 0.7, 1.806}, {0.1513, 0.1415}},
      {shape("Sphere", {{"radius", 2.0, {}}}), {-0.5, -0.7, -1.806}, {0.6513, 0.8585}},
      {shape("cylinder", {{"p1", Vector3d{0, 0, 2}, {}}, {"radius", 0.5, {}}}),
       {0.49, 0.1, 0.5},
       {0.032, 0.25}},
      {shape("cylinder", {{"p1", Vector3d{0, 2, 0}, {}}, {"radius", 0.5, {}}}),
       {0.49, 0.5, 0.1},
       {0.968, 0.25}},
  };
  for (const Case& c : cases) {
    const Reading reading = std::move(Reading().add(c.object));
    const TriangleMesh mesh = reading.mesh();
    const Point3d p = transform_point(inverse(reading.scene.shapes[0].object_to_world), c.point);
    double nearest = 1e9;
    Point2d uv;
    for (const auto& t : mesh.triangles) {  // the triangle whose plane and edges the point is nearest to
      const Vector3d n = area_vector(mesh, t);
      std::array<double, 3> weight{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Point3d a = cast<double>(mesh.positions[t[(i + 1) % 3]]),
                      b = cast<double>(mesh.positions[t[(i + 2) % 3]]);
        weight[i] = dot(cross(b - a, p - a), n) / (2 * dot(n, n));
      }
      const double outside = std::max(0.0, -std::min({weight[0], weight[1], weight[2]}));
      const double off = std::abs(dot(normalize(n), p - cast<double>(mesh.positions[t[0]])));
      if (outside + off >= nearest) continue;
      nearest = outside + off;
      uv = {};
      for (std::size_t i = 0; i < 3; ++i) {
        uv.x += weight[i] * static_cast<double>(mesh.uvs[t[i]].x);
        uv.y += weight[i] * static_cast<double>(mesh.uvs[t[i]].y);
      }
    }
    EXPECT_NEAR(uv.x, c.uv.x, 2e-3) << c.object.type;
    EXPECT_NEAR(uv.y, c.uv.y, 2e-3) << c.object.type;
  }
}

bool flipped(Object object, std::vector<Property> more) {
  for (Property& p : more) object.properties.push_back(std::move(p));
  return Reading().add(object).scene.shapes[0].flip_orientation;
}

TEST(MitsubaShapes, MirrorsKeepTheFrontOfAllButSpheresAndFlatMeshes) {
  TemporaryFolder folder;
  const std::string flat = folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  const std::string smooth =
      folder.write("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n").string();
  const std::string behind =
      folder.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n").string();
  const Property to_world{"to_world", mirror, {}}, flip{"flip_normals", true, {}},
      faces{"face_normals", true, {}};
  const auto obj = [](const std::string& file) { return shape("obj", {{"filename", file, {}}}); };
  for (const char* type : {"rectangle", "cube", "disk", "cylinder"}) {
    EXPECT_TRUE(flipped(shape(type), {to_world})) << type;
    EXPECT_FALSE(flipped(shape(type), {to_world, flip})) << type;
    EXPECT_TRUE(flipped(shape(type), {flip})) << type;
    EXPECT_FALSE(flipped(shape(type), {to_world, two_sided()})) << type;
    EXPECT_TRUE(flipped(shape(type), {to_world, two_sided(), nested("emitter", "area")}));
  }
  EXPECT_FALSE(flipped(shape("sphere"), {to_world}));
  EXPECT_FALSE(flipped(obj(flat), {to_world}));
  EXPECT_TRUE(flipped(obj(smooth), {to_world}));
  EXPECT_FALSE(flipped(obj(smooth), {to_world, faces}));
  EXPECT_TRUE(flipped(obj(behind), {}));
  EXPECT_FALSE(flipped(obj(behind), {to_world}));
}

TEST(MitsubaShapes, ObjIsOneMeshWithItsTextureCoordinatesTurned) {
  TemporaryFolder folder;
  const std::string file =
      folder
          .write("a.obj",
                 "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\nvt .1 .2\nusemtl a\n"
                 "f 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 4/1\n")
          .string();
  Reading reading;
  reading.add(shape("obj", {{"filename", file, {}}}))
      .add(shape("obj", {{"filename", file, {}}, {"to_world", translate({0, 0, 1}), {}}}))
      .add(
          shape("obj", {{"filename", file, {}}, {"flip_tex_coords", false, {}}, {"face_normals", true, {}}}));
  EXPECT_EQ(reading.scene.meshes.size(), 2u);
  EXPECT_EQ(reading.scene.shapes[0].mesh, reading.scene.shapes[1].mesh);
  EXPECT_EQ(reading.mesh().triangles.size(), 2u);
  EXPECT_EQ(reading.mesh().positions.size(), 4u);
  EXPECT_EQ(reading.mesh().uvs[0], (Point2f{.1f, 1 - .2f}));
  EXPECT_EQ(reading.mesh(2).uvs[0], (Point2f{.1f, .2f}));
  EXPECT_TRUE(reading.mesh(2).normals.empty());
  const Normal3f n = reading.mesh().normals[1];  // as Mitsuba 3.9 makes it
  EXPECT_NEAR(n.y, -0.4472136f, 1e-6f);
  EXPECT_NEAR(reading.mesh().normals[0].x, -0.23570228f, 1e-6f);
  EXPECT_THAT(reading.report.take(), testing::IsEmpty());
}

// 3 × 2 heights, which 0.6 makes 3 × 2 patches' corners of: 2¹ + 1 and 2⁰ + 1. The upper row is y = −1.
TEST(MitsubaShapes, HeightFieldsBecomeTriangles) {
  TemporaryFolder folder;
  const auto file = folder.write("h.exr", "");
  write_exr_image(file, {3, 2, 1, {0, .1f, .4f, .2f, .3f, .2f}});
  Reading reading;
  reading.add(shape("heightfield", {{"filename", file.string(), {}}, {"scale", 2.0, {}}}));
  const TriangleMesh& mesh = reading.mesh();
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  const auto at = [&](std::size_t i) {
    return transform_point(reading.scene.shapes.at(0).object_to_world, cast<double>(mesh.positions[i]));
  };
  EXPECT_NEAR(length(at(1) - Point3d{0, -1, .2}), 0, 1e-6);
  EXPECT_NEAR(length(at(5) - Point3d{1, 1, .4}), 0, 1e-6);
  EXPECT_EQ(mesh.uvs[1], (Point2f{.5f, 0}));
  // At (0, 0): one patch, whose sides rise by .2 and .4 a cell, which is 1 wide and 2 high.
  const Vector3d grid = normalize(Vector3d{-.2, -.4, 1}), n = normalize(Vector3d{grid.x, grid.y / 2, grid.z});
  const Normal3d corner =
      transform_normal(reading.scene.shapes[0].object_to_world, cast<double>(mesh.normals[0]));
  EXPECT_NEAR(length(normalize(to_vector(corner)) - n), 0, 1e-6);
  const Diagnostics said = reading.report.take();
  ASSERT_EQ(said.size(), 1u);  // the second patch: |.2 + .4 − .8 − .6| / 4
  EXPECT_THAT(said[0].message, HasSubstr("at most 0.2 in height"));
}

// 4 columns become 5, between their middles.
TEST(MitsubaShapes, HeightFieldsOfOtherSizesAreResampled) {
  TemporaryFolder folder;
  const auto file = folder.write("h.exr", "");
  write_exr_image(file, {4, 1, 1, {0, 1, 2, 3}});
  Reading reading;
  reading.add(shape("heightfield", {{"filename", file.string(), {}}, {"shading_normals", false, {}}}));
  const TriangleMesh& mesh = reading.mesh();
  ASSERT_EQ(mesh.positions.size(), 10u);
  EXPECT_TRUE(mesh.normals.empty());
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(mesh.positions[i].z, std::clamp(.8 * (static_cast<double>(i) + .5) - .5, 0.0, 3.0), 1e-6);
  EXPECT_THAT(reading.report.take().at(0).message, HasSubstr("4 × 1 heights become 5 × 2"));
}

TEST(MitsubaShapes, PlyFilesKeepTheirAttributes) {
  TemporaryFolder folder;
  const auto file = folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty "
      "uchar red\nproperty uchar green\nproperty uchar blue\nproperty float w_0\nproperty float quality\n"
      "property float n_r\nproperty float n_g\nproperty float n_b\nelement face 2\nproperty float c_0\n"
      "property list uchar int vertex_indices\nproperty float p_0\nproperty float p_1\nend_header\n"
      "0 0 0 1 2 3 .5 9 7 8 9\n1 0 0 4 5 6 .6 9 7 8 9\n1 1 0 7 8 9 .7 9 7 8 9\n0 1 0 10 11 12 .8 9 7 8 9\n"
      ".25 4 0 1 2 3 0 0\n.75 3 0 1 2 0 0\n");
  Reading reading;
  reading.add(shape("ply", {{"filename", file.string(), {}}}));
  const auto attributes = reading.mesh().attributes;
  ASSERT_EQ(attributes.size(), 4u);
  EXPECT_EQ(attributes[0],
            (MeshAttribute{"vertex_color", false, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}));
  EXPECT_EQ(attributes[1], (MeshAttribute{"vertex_w", false, 1, {.5f, .6f, .7f, .8f}}));
  EXPECT_EQ(attributes[2].name, "vertex_n_color");
  EXPECT_EQ(attributes[3], (MeshAttribute{"face_c", true, 1, {.25f, .25f, .75f}}));
  EXPECT_EQ(reading.report.take().size(), 3u);  // quality, p_0 and p_1
}

TEST(MitsubaShapes, AttributesSurviveWritingAndReading) {
  TemporaryFolder folder;
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.attributes = {{"vertex_color", false, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9}},
                     {"vertex_wear", false, 1, {1, 2, 3}},
                     {"face_color", true, 3, {1, 2, 3, 4, 5, 6}}};
  write_ply(mesh, folder / "a.ply");
  EXPECT_EQ(read_ply(folder / "a.ply", nullptr, PlyAttributes::read), mesh);
}

TEST(MitsubaShapes, ShapesHaveNamesMediaLightsAndPlaces) {
  Object object = shape("sphere", {{"center", Vector3d{1, 2, 3}, {}},
                                   {"radius", 2.0, {}},
                                   {"to_world", scale({2, 2, 2}), {}},
                                   nested("medium", "homogeneous", "interior"),
                                   nested("medium", "homogeneous", "exterior"),
                                   nested("emitter", "area"),
                                   {"raduis", 2.0, {0, 8, 1}}});
  object.id = "ball";
  Reading reading;
  reading.add(object);
  const Shape& ball = reading.scene.shapes.at(0);
  EXPECT_EQ(ball.name, "ball");
  EXPECT_EQ(ball.origin.line, 7u);
  EXPECT_TRUE(ball.interior && ball.exterior && ball.area_light);
  EXPECT_EQ(transform_point(ball.object_to_world, {0, 0, 1}), (Point3d{2, 4, 10}));
  const Diagnostics diagnostics = reading.report.take();
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_THAT(diagnostics[0].message, HasSubstr("raduis"));
  EXPECT_EQ(diagnostics[0].item.line, 7);
}

TEST(MitsubaShapes, GroupsBecomePrototypes) {
  Object group =
      shape("shapegroup", {nested(shape("rectangle")), nested(shape("cube", {nested("emitter", "area")}))});
  group.id = "group";
  const auto shared = std::make_shared<const Object>(group);
  Reading reading;
  reading.add(*shared)
      .add(shape("instance", {{"", ObjectPtr(shared), {}}, {"to_world", translate({1, 0, 0}), {}}}))
      .add(shape("instance", {{"", ObjectPtr(shared), {}}}))
      .add(shape("merge", {nested(shape("rectangle")), nested(shape("rectangle"))}));
  EXPECT_EQ(reading.scene.prototypes.size(), 1u);
  EXPECT_EQ(reading.scene.prototypes[0].name, "group");
  EXPECT_EQ(reading.scene.prototypes[0].shapes.size(), 2u);
  EXPECT_FALSE(reading.scene.prototypes[0].shapes[1].area_light);
  EXPECT_EQ(reading.scene.instances.size(), 2u);
  EXPECT_EQ(reading.scene.instances[0].prototype_to_world, translate({1, 0, 0}));
  EXPECT_EQ(reading.scene.shapes.size(), 2u);
  EXPECT_EQ(reading.scene.meshes.size(), 2u);
  const Diagnostics diagnostics = reading.report.take();
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_THAT(diagnostics[0].message, HasSubstr("emitters in shape groups"));
  EXPECT_THAT(error_of(shape("instance")), HasSubstr("scene.xml:7:3: an instance needs"));
}

TEST(MitsubaShapes, UnknownKindsAreDropped) {
  Reading reading;
  reading.add(shape("deformable")).add(shape("spere")).add(shape("ellipsoids"));
  EXPECT_TRUE(reading.scene.shapes.empty());
  const Diagnostics diagnostics = reading.report.take();
  ASSERT_EQ(diagnostics.size(), 3u);
  EXPECT_THAT(diagnostics[1].message, HasSubstr("did you mean \"sphere\""));
}

// Curves stay curves; what is tessellated of them has the area of the tubes.
TEST(MitsubaShapes, CurvesStayCurves) {
  TemporaryFolder folder;
  const std::string file =
      folder
          .write("c.txt",
                 "0 0 0 .1\n1 0 0 .1\n2 0 0 .1\n3 0 0 .1\n\n\n0 5 0 .2\n0 5 1 .2\n0 5 2 .2\n0 5 3 .2\n")
          .string();
  const Reading bspline = std::move(Reading().add(shape("bsplinecurve", {{"filename", file, {}}})));
  ASSERT_TRUE(is_curve(bspline.stored().quadric.value()));
  EXPECT_EQ(bspline.stored().places->size(), 2u);
  expect_fronts_follow_normals(bspline.mesh());
  EXPECT_NEAR(area(bspline.mesh()), 2 * pi * (.1 + .2), 0.02);
  const Reading linear = std::move(Reading().add(shape("linearcurve", {{"filename", file, {}}})));
  ASSERT_TRUE(is_curve(linear.stored().quadric.value()));
  EXPECT_EQ(linear.stored().places->size(), 6u);
  expect_fronts_follow_normals(linear.mesh());
  EXPECT_NEAR(area(linear.mesh()), 2 * pi * 3 * (.1 + .2) + 4 * pi * (.01 + .04), 0.1);
  for (const TriangleMesh& mesh : {bspline.mesh(), linear.mesh()})
    for (const Point2f uv : mesh.uvs) ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
}

// As in Mitsuba 3.9.1, where a transform takes centres along and leaves radii.
TEST(MitsubaShapes, TransformsLeaveTheRadiiOfCurves) {
  TemporaryFolder folder;
  const std::string file = folder.write("c.txt", "0 0 0 .1\n1 0 0 .1\n2 0 0 .1\n3 0 0 .1\n").string();
  const auto read = [&](const Transform& t) {
    const Reading reading =
        std::move(Reading().add(shape("linearcurve", {{"filename", file, {}}, {"to_world", t, {}}})));
    return test::curves_of(reading.scene, reading.scene.shapes).at(2);
  };
  const PlacedCurve moved = read(translate({1, 2, 3}) * rotate(pi / 2, {0, 0, 1}));
  EXPECT_LT(length(moved.origin - Point3d{1, 4, 3}), 1e-9);
  EXPECT_FLOAT_EQ(moved.radius[0], .1f);
  for (const Transform& t : {vitrail::scale({5, 5, 5}), vitrail::scale({5, 1, 2})}) {
    const PlacedCurve larger = read(t);
    EXPECT_EQ(larger.origin, (Point3d{10, 0, 0}));
    EXPECT_EQ(larger.to[2].x, 5);
    EXPECT_EQ(larger.radius[0], .1f);
  }
}

// 0.6's: as text and binary, one radius for all; points alone are no hair.
TEST(MitsubaShapes, HairOf06IsCurves) {
  TemporaryFolder folder;
  const float end = INFINITY;
  const std::string text =
      folder.write("h.txt", "0 0 0\n1 0 0\n3 0 0\n\n7 7 7\n# next\n0 5 0\n0 5 1\n").string();
  std::string binary = "BINARY_HAIR" + bytes(6u, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 3.f, 0.f, 0.f, end, 7.f, 7.f,
                                             7.f, end, 0.f, 5.f, 0.f, 0.f, 5.f, 1.f);
  const auto read = [&](const std::string& file) {
    return std::move(Reading().add(shape("hair", {{"filename", file, {}}, {"radius", .1, {}}})));
  };
  const Reading as_text = read(text), as_binary = read(folder.write("h.hair", binary).string());
  EXPECT_NEAR(area(as_text.mesh()), 2 * pi * .1 * 4, 0.05);
  expect_fronts_follow_normals(as_text.mesh());
  EXPECT_EQ(as_text.mesh(), as_binary.mesh());
  const auto error = [&](const std::string& content, double radius = .1) {
    return error_of(
        shape("hair", {{"filename", folder.write("e.hair", content).string(), {}}, {"radius", radius, {}}}));
  };
  EXPECT_THAT(error("0 0 0\n1 x 0\n"), HasSubstr("e.hair:2:3"));
  EXPECT_THAT(error("0 0 0\n\n"), HasSubstr("no hair"));
  EXPECT_THAT(error("0 0 0\n1 0 0\n", 0), HasSubstr("the radius of hair is 0"));
  EXPECT_THAT(error(binary.substr(0, binary.size() - 1)), HasSubstr("ends within its points"));
  EXPECT_THAT(error("BINARY_HAIR" + bytes(1u, NAN, 0.f, 0.f)), HasSubstr("point 0 is not finite"));
}

TEST(Curves, BasesAgreeWhereTheyDescribeOneCurve) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, 1}, {{1, 2, 0}, 2}, {{3, 2, 1}, 1}, {{4, 0, 0}, 3}};
  const auto cubic = bspline_segments(points);
  ASSERT_EQ(cubic.size(), 1u);
  // (p0 + 4·p1 + p2) / 6 and (p1 + 4·p2 + p3) / 6
  EXPECT_NEAR(cubic[0][0].position.x, 7.0 / 6, 1e-15);
  EXPECT_NEAR(cubic[0][0].radius, 10.0 / 6, 1e-15);
  EXPECT_NEAR(cubic[0][3].position.y, 10.0 / 6, 1e-15);
  const auto quadratic = quadratic_bspline_segments(points);
  ASSERT_EQ(quadratic.size(), 2u);
  EXPECT_EQ(quadratic[0][3].position, quadratic[1][0].position);
  EXPECT_EQ(quadratic[0][0].position, (Point3d{0.5, 1, 0}));
  const auto bezier = quadratic_bezier_segments(std::span(points).first(3));
  EXPECT_NEAR(bezier[0][1].position.y, 4.0 / 3, 1e-15);
  EXPECT_EQ(bezier_segments(points).size(), 1u);
  EXPECT_EQ(linear_segments(points).size(), 3u);
  EXPECT_EQ(bspline_segments(std::span(points).first(3)).size(), 0u);
}

TEST(Curves, TubesThatBendTurnBackOrEndInAPointKeepTheirFront) {
  const std::vector<CurvePoint> bent{{{0, 0, 0}, .1}, {{0, 0, 1}, .1}, {{0, 1, 1}, .1}, {{1, 1, 0}, 0}};
  TriangleMesh mesh;
  append_tube(bezier_segments(bent), {16, 12}, 0, 1, false, mesh);
  expect_fronts_follow_normals(mesh);
  TriangleMesh back;
  const std::vector<CurvePoint> hairpin{{{0, 0, 0}, .1}, {{1, 0, 0}, .1}, {{0, 0, 0}, .1}, {{0, 0, 0}, .1}};
  append_tube(linear_segments(hairpin), {1, 4}, 0, 1, true, back);
  for (const Normal3f n : back.normals) ASSERT_TRUE(std::isfinite(n.x + n.y + n.z));
  TriangleMesh none;
  const std::vector<CurvePoint> point(4, {{1, 1, 1}, 1});
  append_tube(bezier_segments(point), {4, 4}, 0, 1, true, none);
  EXPECT_TRUE(none.triangles.empty());
  EXPECT_THROW(curve_detail(1000000000, false), Error);
}

TEST(Curves, RibbonsFaceTheirNormals) {
  const std::vector<CurvePoint> straight{{{0, 0, 0}, .5}, {{1, 0, 0}, .5}, {{2, 0, 0}, .5}, {{3, 0, 0}, .5}};
  const std::vector<Vector3d> normals{{0, 0, 1}, {0, 2, 0}};
  TriangleMesh mesh;
  append_ribbon(bezier_segments(straight), normals, 8, mesh);
  expect_fronts_follow_normals(mesh);
  EXPECT_EQ(mesh.positions.size(), 18u);
  EXPECT_NEAR(mesh.normals[8].y, std::sqrt(0.5), 1e-6);  // half-way
  EXPECT_EQ(mesh.uvs[17], (Point2f{1, 1}));
  EXPECT_EQ(mesh.positions[0], (Point3f{0, -.5f, 0}));
}

TEST(MitsubaShapes, BadCurvesAreErrorsWithTheirPlace) {
  TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    return error_of(shape("bsplinecurve", {{"filename", folder.write("c.txt", text).string(), {}}}));
  };
  EXPECT_THAT(error("0 0 0 1\n1 0 0 1\n2 0 0 1\n3 0 0 -20\n"),
              HasSubstr("c.txt:4:10: the radius -2.5 is negative"));
  EXPECT_THAT(error("0 0 nan 1\n"), HasSubstr("c.txt:1:5"));
  EXPECT_THAT(error("0 0 0\n"), HasSubstr("c.txt:1:6"));
  EXPECT_THAT(error("0 0 0 1\n\n0 0 0 1\n"), HasSubstr("has 1 control points, but needs 4"));
  EXPECT_THAT(error(""), HasSubstr("no curves"));
  // A cone to its point has a negative radius behind it, but no curve has.
  const std::string cone = "0 0 0 .2\n1 0 0 .1\n2 0 0 0\n3 0 0 ";
  folder.write("cone.txt", cone + "-.1\n");
  EXPECT_EQ(Reading()
                .add(shape("bsplinecurve", {{"filename", (folder / "cone.txt").string(), {}}}))
                .stored()
                .places->size(),
            1u);
  EXPECT_THAT(error(cone + "-.2\n"), HasSubstr("c.txt:4"));
}

TEST(MitsubaShapes, BadParametersAreErrorsWithTheirPlace) {
  const auto number = [](const char* type, double radius) {
    return error_of(shape(type, {{"radius", radius, {0, 9, 5}}}));
  };
  EXPECT_THAT(number("sphere", -1), HasSubstr("scene.xml:9:5: the radius is -1"));
  EXPECT_THAT(number("sphere", NAN), HasSubstr("the radius is nan"));
  EXPECT_THAT(number("cylinder", 0), HasSubstr("the radius is 0"));
  EXPECT_THAT(error_of(shape("cylinder", {{"p1", Vector3d{}, {}}})), HasSubstr("same point"));
  EXPECT_THAT(error_of(shape("sphere", {{"center", Vector3d{INFINITY, 0, 0}, {}}})), HasSubstr("not finite"));
  EXPECT_THAT(error_of(shape("cube", {{"to_world", scale({NAN, 0, 0}), {}}})), HasSubstr("not finite"));
  EXPECT_THAT(error_of(shape("obj")), HasSubstr("scene.xml:7:3: shape \"obj\" needs a string \"filename\""));
  EXPECT_THAT(error_of(shape("ply", {{"filename", std::string("none.ply"), {0, 9, 5}}})),
              HasSubstr("scene.xml:9:5: cannot find"));
  EXPECT_THAT(error_of(shape("serialized", {{"filename", std::string("/tmp"), {0, 9, 5}}})),
              HasSubstr("scene.xml:9:5: cannot find"));
}

}  // namespace
}  // namespace vitrail::mitsuba::mitsuba_read_shapes_test
