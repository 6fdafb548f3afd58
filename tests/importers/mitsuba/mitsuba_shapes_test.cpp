// SPDX-License-Identifier: Apache-2.0
// Shapes, their sides, instances and media as Mitsuba 3 reads them from written files.

#include "scene/geometry/pi.h"
#include "scene/shapes/tessellate.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"

namespace vitrail::mitsuba_shapes_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

TEST_F(MitsubaOracle, FrontsOfAllKindsOfMesh) {
  Scene scene = empty_scene();
  const auto plain = add_to(scene.meshes, square_mesh()), smooth = add_to(scene.meshes, square_mesh(true));
  Material one_sided;
  one_sided.two_sided = false;
  const auto material = add_to(scene.materials, one_sided);
  const auto light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{2}}});
  std::vector<double> fronts;  // +1 where the front faces +z
  Json queries = Json::array();
  for (const auto mesh : {plain, smooth})
    for (const double mirror : {1.0, -1.0})
      for (const bool flip : {false, true}) {
        const double x = 10.0 * static_cast<double>(fronts.size());
        scene.shapes.push_back(
            {mesh, material, light, 1.0f, translate({x, 0, 0}) * vitrail::scale({mirror, 1, 1}), flip});
        fronts.push_back((mirror > 0) != flip ? 1 : -1);
        for (const double side : {1.0, -1.0}) {
          queries.push_back(ray("hit", {x + 0.5, 0.25, side * 3}, {0, 0, -side}));
          queries.push_back(ray("bsdf", {x + 0.5, 0.25, side * 3}, {0, 0, -side}));
          queries.back()["wo"] = {0, 0, side};
        }
      }
  const Json answer = ask(scene, queries);
  for (std::size_t i = 0; i < fronts.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side) {
      const Json &hit = answer.at(4 * i + 2 * side), &bsdf = answer.at(4 * i + 2 * side + 1);
      const bool front = (fronts[i] > 0) == (side == 0);
      EXPECT_NEAR(hit["n"][2].get<double>(), fronts[i], 1e-6) << i;
      EXPECT_NEAR(hit["shading_n"][2].get<double>(), fronts[i], 1e-6) << i;
      EXPECT_NEAR(hit["emission"][0].get<double>(), front ? 2 : 0, 1e-6) << i;
      EXPECT_NEAR(bsdf["value"][0].get<double>(), front ? 0.5 / pi : 0, 1e-6) << i;
    }
}

TEST_F(MitsubaOracle, GlassHasItsIndexBehindTheFront) {
  Material glass;
  glass.model = DielectricMaterial{};
  Scene scene = square_scene(glass, true);
  for (const bool mirrored : {false, true}) {
    scene.shapes[0].object_to_world = vitrail::scale({mirrored ? -1.0 : 1.0, 1, 1});
    scene.shapes[0].flip_orientation = mirrored;
    Json from_front = ray("sampled", {0.1, 0.2, 3}, {0, 0, -1}),
         from_behind = ray("sampled", {0.1, 0.2, -3}, {0, 0, 1});
    from_front["u"] = from_behind["u"] = 0.9;  // refracted
    const Json answer = ask(scene, {from_front, from_behind});
    EXPECT_NEAR(answer[0]["eta"].get<double>(), 1.5, 1e-6);
    EXPECT_NEAR(answer[1]["eta"].get<double>(), 1 / 1.5, 1e-6);
  }
}

// What a ray finds of a quadric is what it finds of the same as triangles, to their distance from it.
TEST_F(MitsubaOracle, QuadricsAreTheirTriangles) {
  Scene scene = empty_scene();
  scene.files = {"cases"};
  Material one_sided;
  one_sided.two_sided = false;
  add_to(scene.textures, Texture{UvTexture{}, false});
  one_sided.model = DiffuseMaterial{SpectrumParameter{Id<Texture>{0}}};
  const auto material = add_to(scene.materials, one_sided);
  const auto light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{2}}});
  const Transform turned = rotate(0.9, {1, 2, 3}), mirror = vitrail::scale({1, -1, 1});
  struct Case {
    Quadric quadric;
    Transform to_world;
    bool exact;
  };
  std::vector<Case> cases;
  for (const QuadricUv uv : {QuadricUv::pbrt, QuadricUv::mitsuba})
    for (const Transform& sides : {Transform{}, mirror}) {
      cases.push_back(
          {{.kind = QuadricKind::sphere, .uv = uv}, turned * sides * vitrail::scale({2, 2, 2}), true});
      cases.push_back({{.kind = QuadricKind::sphere, .uv = uv}, sides * vitrail::scale({1, 1, 2}), false});
      cases.push_back({{.kind = QuadricKind::disk, .uv = uv, .low = 0},
                       turned * sides * vitrail::scale({2, 3, 1}),
                       uv == QuadricUv::mitsuba});
      cases.push_back(
          {{.kind = QuadricKind::cylinder, .uv = uv}, turned * sides * vitrail::scale({1, 1, 3}), true});
      cases.push_back({{.kind = QuadricKind::cone, .uv = uv}, turned * sides, false});
    }
  cases.push_back({{.kind = QuadricKind::sphere, .low = -0.5, .phi_max_rad = 5}, turned, false});
  cases.push_back({{.kind = QuadricKind::disk, .low = 0.5}, turned, false});
  Json queries = Json::array();
  for (std::size_t i = 0; i < 2 * cases.size(); ++i) {
    const Case& c = cases[i / 2];
    const Transform there = translate({20.0 * static_cast<double>(i), 0, 0}) * c.to_world;
    TriangleMesh mesh;
    mesh.quadric = c.quadric;
    scene.shapes.push_back({add_to(scene.meshes, mesh), material, light, 1.0f, there, i % 2 == 1});
    scene.shapes.back().origin.line = static_cast<std::uint32_t>(i + 1);  // each is told by its place
    // From both sides of a point of it.
    const double phi = 1.1, z = c.quadric.kind == QuadricKind::disk ? 0 : 0.3,
                 rho = c.quadric.kind == QuadricKind::sphere     ? std::sqrt(1 - z * z)
                       : c.quadric.kind == QuadricKind::disk     ? 0.7
                       : c.quadric.kind == QuadricKind::cylinder ? 1
                                                                 : 1 - z;
    const Point3d p{rho * std::cos(phi), rho * std::sin(phi), z};
    const Vector3d out = c.quadric.kind == QuadricKind::disk ? Vector3d{0.1, 0, 0.5} : (p - Point3d{}) * 0.3;
    for (const double side : {1.0, -1.0}) {
      const Point3d from = transform_point(there, p + out * side);
      const Vector3d along = normalize(transform_vector(there, out * -side));
      queries.push_back(ray("hit", {from.x, from.y, from.z}, {along.x, along.y, along.z}));
    }
  }
  const Json found = ask(scene, queries);
  const auto is_of_triangles = [](const Diagnostic& d) {
    return d.message.find("becomes triangles, 256 for a full turn") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(diagnostics_, is_of_triangles),
            2 * std::ranges::count(cases, false, &Case::exact));
  for (TriangleMesh& mesh : scene.meshes) mesh = tessellate(*mesh.quadric);
  const Json expected = ask(scene, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_TRUE(expected[i]["valid"].get<bool>());
    for (const char* key : {"p", "shading_n", "emission", "uv"}) {
      const std::vector<double> values = expected[i][key].get<std::vector<double>>();
      for (std::size_t k = 0; k < values.size(); ++k)
        EXPECT_NEAR(found[i][key][k].get<double>(), values[k], 2e-3) << key;
    }
  }
}

TEST_F(MitsubaOracle, QuadricsInInstancesAndBehindLights) {
  Scene scene = square_scene({});
  TriangleMesh ball;
  ball.quadric = Quadric{.kind = QuadricKind::sphere, .uv = QuadricUv::mitsuba};
  scene.shapes[0].mesh = add_to(scene.meshes, ball);
  const Shape shape = scene.shapes[0];
  const auto group = add_to(scene.prototypes, Prototype{"group", {shape}, {}});
  scene.instances.push_back({group, translate({10, 0, 0}) * vitrail::scale({2, 2, 2}), {}});
  // Both sides shine.
  scene.shapes[0].area_light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{3}}, 1, true});
  const Json answer = ask(scene, {ray("hit", {10, 0, 9}, {0, 0, -1}), ray("hit", {0.1, 0.2, 9}, {0, 0, -1}),
                                  ray("hit", {0.1, 0.2, 0.3}, {0, 0, -1})});
  EXPECT_NEAR(answer[0]["p"][2].get<double>(), 2, 1e-5);
  EXPECT_NEAR(answer[1]["emission"][0].get<double>(), 3, 1e-5);
  EXPECT_NEAR(answer[2]["emission"][0].get<double>(), 3, 1e-5);
  EXPECT_THAT(text(), HasSubstr("radius"));
}

TEST_F(MitsubaOracle, TransformsAndNames) {
  Scene scene = square_scene({});
  scene.shapes[0].name = "a <\"strange\"> & näme";
  scene.shapes[0].object_to_world =
      translate({1, 2, 3}) * rotate(pi / 2, {0, 1, 0}) * vitrail::scale({2, 3, 1});
  const Json box = ask(scene, {{{"op", "shapes"}}}).at(0).at(0);
  EXPECT_EQ(box["id"], scene.shapes[0].name);
  expect_near(box["min"], {1, -1, 1}, 1e-6);
  expect_near(box["max"], {1, 5, 5}, 1e-6);
}

TEST_F(MitsubaOracle, InstancesAndTheirLights) {
  Scene scene = square_scene({});
  const auto light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{3}}});
  Shape shape = scene.shapes[0];
  shape.object_to_world = translate({0, 0, 1});
  Shape shining = shape;
  shining.area_light = light;
  shining.object_to_world = translate({0, 0, 2});
  scene.shapes.clear();
  const auto group = add_to(scene.prototypes, Prototype{"group", {shape, shining}, {}});
  scene.instances.push_back({group, translate({10, 0, 0}), {}});
  scene.instances.push_back({group, translate({20, 0, 0}) * vitrail::scale({-1, 1, 1}), {}});
  const Json answer =
      ask(scene, {ray("hit", {10.3, 0.2, 9}, {0, 0, -1}), ray("hit", {20.3, 0.2, 9}, {0, 0, -1}),
                  ray("hit", {20.3, 0.2, -9}, {0, 0, 1})});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(answer[i]["p"][2].get<double>(), 2, 1e-5);
    EXPECT_NEAR(answer[i]["emission"][0].get<double>(), 3, 1e-5);
  }
  EXPECT_NEAR(answer[2]["p"][2].get<double>(), 1, 1e-5);
  EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr("instances no area lights"))));
}

TEST_F(MitsubaOracle, TwoSidedEmission) {
  for (const bool flip : {false, true}) {
    Scene scene = square_scene({}, flip);
    scene.shapes[0].area_light = add_to(scene.area_lights, AreaLight{Spectrum{ConstantSpectrum{3}}, 1, true});
    scene.shapes[0].flip_orientation = flip;
    scene.shapes[0].object_to_world = vitrail::scale({flip ? -1.0 : 1.0, 1, 1});
    const Json answer =
        ask(scene, {ray("hit", {0.3, 0.2, 9}, {0, 0, -1}), ray("hit", {0.3, 0.2, -9}, {0, 0, 1})});
    for (const Json& side : answer) EXPECT_NEAR(side["emission"][0].get<double>(), 3, 1e-5);
  }
}

// ---- Media

TEST_F(MitsubaOracle, HomogeneousMedia) {
  Scene scene = square_scene({});
  scene.materials[0].model = InterfaceMaterial{};
  Medium medium;
  const Spectrum absorption = unbounded_from_rgb({0.5, 1, 2}), scattering = ConstantSpectrum{3};
  medium.coefficients = AbsorptionScattering{absorption, scattering};
  medium.scale = 2;
  medium.g = 0.5f;
  medium.name = "fog";
  scene.shapes[0].interior = add_to(scene.media, medium);
  scene.camera_medium = Id<Medium>{0};
  const Json answer =
      ask(scene, {{{"op", "medium"}, {"index", 0}, {"p", {0, 0, 0}}, {"wavelengths", wavelengths_nm}},
                  ray("hit", {0.3, 0.2, 3}, {0, 0, -1})});
  std::vector<double> extinction;
  for (const double a : values(absorption)) extinction.push_back(2 * (a + 3));
  expect_near(answer[0]["sigma_t"], extinction, 1e-4);
  expect_near(answer[0]["sigma_s"], {6, 6, 6, 6}, 1e-3);
  EXPECT_NEAR(answer[0]["forward"][0].get<double>(), 0.75 / (4 * pi * 0.125), 1e-4);  // (1−g²)/(4π(1−g)³)
  EXPECT_EQ(answer[1]["interior"], "fog");
  EXPECT_EQ(answer[1]["exterior"], "");
}

TEST_F(MitsubaOracle, GridsOfDensity) {
  Scene scene = square_scene({});
  Grid grid;
  grid.nx = 2, grid.ny = 1, grid.nz = 1;
  grid.values = {1, 3};
  grid.bounds = {{0, 0, 0}, {4, 1, 1}};
  Medium medium;
  medium.coefficients =
      AbsorptionScattering{Spectrum{ConstantSpectrum{0.5f}}, Spectrum{ConstantSpectrum{1.5f}}};
  medium.density = grid;
  medium.medium_to_world = translate({10, 0, 0});
  scene.shapes[0].interior = add_to(scene.media, medium);
  const auto at = [](double x) {
    return Json{{"op", "medium"}, {"index", 0}, {"p", {x, 0.5, 0.5}}, {"wavelengths", wavelengths_nm}};
  };
  const Json answer = ask(scene, {at(10.5), at(12), at(13.5)});
  EXPECT_NEAR(answer[0]["sigma_t"][0].get<double>(), 2, 1e-4);
  EXPECT_NEAR(answer[1]["sigma_t"][0].get<double>(), 4, 1e-4);
  EXPECT_NEAR(answer[2]["sigma_t"][0].get<double>(), 6, 1e-4);
  EXPECT_NEAR(answer[1]["sigma_s"][0].get<double>(), 3, 1e-4);
}

// A cone to its point, which a B-spline has with a negative radius at its last control point: it is as wide
// as it should be all along, ends where it should, and stretches with an instance.
TEST_F(MitsubaOracle, CurvesHaveTheirWidthAndEnds) {
  const std::vector<CurvePoint> axis{{{0, 0, 0}, .3}, {{1, 0, 0}, .2}, {{2, 0, 0}, .1}, {{3, 0, 0}, 0}};
  const auto bent = placed_curves(bezier_segments(axis), 0, 1, false, false);
  const auto straight = placed_curves(linear_segments(axis), 0, 1, true, true);
  Scene scene = square_scene({});
  scene.shapes = {test::add_curves(scene, bent, QuadricUv::mitsuba)};
  const double tilt =
      1 / std::sqrt(1 - .01);  // radii are balls' on a straight segment, circles' on a bent one
  for (const bool is_straight : {false, true}) {
    const Id<TriangleMesh> mesh =
        test::add_curves(scene, is_straight ? straight : bent, QuadricUv::mitsuba).mesh;
    Shape shape = scene.shapes[0];
    shape.mesh = mesh;
    scene.shapes = {shape};
    scene.prototypes = {{"p", {shape}, {}, {}}};
    scene.instances = {{{0}, translate({0, 5, 0}) * vitrail::scale({1, 2, 1}), {}}};
    Json queries = Json::array();
    std::vector<bool> meets;
    for (const double x : {.05, .7, 1.5, 2.2, 2.9})
      for (const double off : {.99, 1.01})
        for (const bool instance : {false, true}) {
          const double radius = .3 - x / 10, width = (is_straight ? radius * tilt : radius) * off;
          queries.push_back(ray("hit", {x, instance ? 5 + 2 * width : width, 5}, {0, 0, -1}));
          meets.push_back(off < 1);
        }
    for (const double x : {-.01, 3.01}) {
      queries.push_back(ray("hit", {x, 1e-4, 5}, {0, 0, -1}));
      meets.push_back(is_straight && x < 0);
    }
    const Json answer = ask(scene, queries);
    EXPECT_TRUE(diagnostics_.empty());
    ASSERT_EQ(answer.size(), meets.size());
    for (std::size_t i = 0; i < meets.size(); ++i)
      EXPECT_EQ(answer[i]["valid"].get<bool>(), meets[i]) << is_straight << ' ' << i << ' ' << queries[i];
  }
}

}  // namespace
}  // namespace vitrail::mitsuba_shapes_test
