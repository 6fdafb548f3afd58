// SPDX-License-Identifier: Apache-2.0
// POV-Ray itself shows of the files that are written what the Scene says.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "scene/geometry/pi.h"
#include "scene/shapes/tessellate.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/povray/povray_oracle.h"
#include "tests/support/png.h"

namespace vitrail::povray_oracle_test {
namespace {

// ---- Radiometry ---------------------------------------------------------------------------------

TEST_F(PovrayOracle, PointLight) {
  Scene scene = plane();
  scene.lights.push_back({PointLight{{.5, -.25, 1.5}, emission_from_rgb({4, 3, 2})}});
  expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
    const double dx = x - .5, dy = y + .25, d2 = dx * dx + dy * dy + 2.25;
    const double factor = 1.5 / std::sqrt(d2) / d2 / pi;
    return {4 * .8 * factor, 3 * .5 * factor, 2 * .25 * factor};
  });
}

TEST_F(PovrayOracle, DistantLightAndImagingRatio) {
  Scene scene = plane();
  scene.film.imaging_ratio = 0.5;
  scene.lights.push_back({DistantLight{normalize(Vector3d{1, 2, -2}), emission_from_rgb({3, 2, 1})}});
  expect_plane(scene, [](double, double) -> std::array<double, 3> {
    const double factor = 0.5 * (2.0 / 3) / pi;
    return {3 * .8 * factor, 2 * .5 * factor, 1 * .25 * factor};
  });
}

TEST_F(PovrayOracle, SpotLightFallsAsTheSmoothstepOfTheCosine) {
  Scene scene = plane();
  SpotLight spot;
  spot.light_to_world = translate({0, 0, 2}) * scale({1, 1, -1});
  spot.intensity = emission_from_rgb({3, 3, 3});
  spot.beam_deg = 15;
  spot.cutoff_deg = 45;
  scene.lights.push_back({spot});
  expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
    const double d2 = x * x + y * y + 4, c = 2 / std::sqrt(d2);
    const double outer = std::cos(pi / 4), inner = std::cos(pi / 12);
    const double s = std::clamp((c - outer) / (inner - outer), 0.0, 1.0);
    const double factor = 3 * c / d2 / pi * s * s * (3 - 2 * s);
    return {.8 * factor, .5 * factor, .25 * factor};
  });
}

// ∫ L cos θ cos θ' / d² dA over the square of side 1 around (3,0,1) that faces down, at (x,y,0).
double irradiance_of_square(double x, double y) {
  constexpr int n = 100;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double dx = 2.5 + (i + .5) / n - x, dy = -.5 + (j + .5) / n - y, d2 = dx * dx + dy * dy + 1;
      sum += 1 / d2 / d2 / (n * n);
    }
  return sum;
}

TEST_F(PovrayOracle, SquareLight) {
  for (const bool flipped : {false, true}) {
    Scene scene = plane();
    TriangleMesh lamp = square(2.5f, 3.5f, -.5f, .5f, 1);
    if (!flipped) std::swap(lamp.positions[1], lamp.positions[3]);
    add_emitter(scene, lamp, {4, 3, 2}).flip_orientation = flipped;
    expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
      const double factor = irradiance_of_square(x, y) / pi;
      return {4 * .8 * factor, 3 * .5 * factor, 2 * .25 * factor};
    });
  }
}

TEST_F(PovrayOracle, SquareLightsShineAndAreSeenFromTheirFrontOnly) {
  for (const bool two_sided : {false, true}) {
    Scene scene = empty_povray_scene();
    add_emitter(scene, square(-1.8f, -.2f, -1.8f, 1.8f, 0), {.6, .4, .2});  // faces the camera
    TriangleMesh away = square(.2f, 1.8f, -1.8f, 1.8f, 0);
    for (auto& t : away.triangles) std::swap(t[1], t[2]);
    away.normals = {{0, 0, 1}, {.1f, 0, 1}, {0, .1f, 1}, {.1f, .1f, 1}};  // which do not decide sides
    add_emitter(scene, away, {.6, .4, .2});
    scene.area_lights.back().two_sided = two_sided;
    const Colors seen = quarters(scene);
    ASSERT_EQ(seen.size(), 4u);
    EXPECT_NEAR(seen[0][1], .4, 1e-3);
    EXPECT_NEAR(seen[1][1], two_sided ? .4 : 0, 1e-3);
  }
}

// ¾ of a black card are not there, nor of one that shines.
TEST_F(PovrayOracle, OpacitiesOfShapes) {
  Scene scene = plane({.8, .8, .8});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
  add(scene, square(-5, 5, -5, 5, .5), diffuse({0, 0, 0}));
  scene.shapes.back().opacity = 0.25f;
  expect_plane(scene, [](double, double) -> std::array<double, 3> {
    return {.45, .45, .45};  // ¾ of the light, ¾ of what it shows
  });
  scene.lights.clear();
  scene.shapes.resize(1);
  add_emitter(scene, square(-5, 5, -5, 5, .5), {2, 2, 2}).opacity = 0.25f;
  scene.settings.max_depth = 0;
  expect_plane(scene, [](double, double) -> std::array<double, 3> { return {.5, .5, .5}; });
}

// ¾ of a black curve are not there: a ray meets a curve once, and the sweep that is written for it twice.
TEST_F(PovrayOracle, OpacitiesOfCurves) {
  Scene scene = empty_povray_scene();
  add_emitter(scene, square(-5, 5, -5, 5, 0), {.8, .8, .8});
  const std::vector<CurvePoint> points{{{0, -9, .9}, .8}, {{0, 9, .9}, .8}};
  scene.shapes.push_back(
      test::add_curves(scene, placed_curves(linear_segments(points), 0, 1, true, true), QuadricUv::pbrt));
  scene.shapes.back().material = {static_cast<std::uint32_t>(scene.materials.size())};
  scene.materials.push_back(Material{diffuse({0, 0, 0})});
  scene.shapes.back().opacity = 0.25f;
  scene.settings.max_depth = 4;
  const PovPicture picture = render_povray(scene, folder_);
  ASSERT_FALSE(picture.values.empty());
  for (const int y : {2, 16, 29}) EXPECT_NEAR(picture.at(picture.width / 2, y)[1], 0.6, 0.005) << y;
  EXPECT_NEAR(picture.at(1, 16)[1], 0.8, 0.005);
}

// What is behind shows through, brighter by the lamp's radiance; from behind it is alone.
TEST_F(PovrayOracle, LampsOfNothing) {
  for (const bool flipped : {false, true}) {
    Scene scene = empty_povray_scene();
    scene.settings.max_depth = 4;
    add_emitter(scene, square(-5, 5, -5, 5, 0), {.4, .4, .4});
    add_emitter(scene, square(-5, 5, -5, 5, .5), {.2, .3, .4}).flip_orientation = flipped;
    scene.materials.back().model = InterfaceMaterial{};
    expect_plane(scene, [&](double, double) -> std::array<double, 3> {
      if (flipped) return {.4, .4, .4};
      return {.6, .7, .8};
    });
  }
}

// Of each the front shines and the back is black, as of its triangles; those that POV-Ray has stay
// themselves.
TEST_F(PovrayOracle, QuadricsAreTheirTriangles) {
  Scene scene = empty_povray_scene();
  scene.film.width = scene.film.height = 96;
  scene.film.crop = {0, 96, 0, 96};
  scene.area_lights.push_back({emission_from_rgb({1, 0, 0})});
  const std::array quadrics{Quadric{.kind = QuadricKind::sphere},
                            Quadric{.kind = QuadricKind::disk, .low = 0.4},
                            Quadric{.kind = QuadricKind::cylinder},
                            Quadric{.kind = QuadricKind::cone},
                            Quadric{.kind = QuadricKind::paraboloid, .low = 0.1},
                            Quadric{.kind = QuadricKind::sphere, .low = -0.5, .high = 0.4}};
  for (std::size_t i = 0; i < quadrics.size(); ++i)
    for (int sides = 0; sides < 4; ++sides) {
      TriangleMesh mesh;
      mesh.quadric = quadrics[i];
      Shape& shape = add(scene, mesh, DiffuseMaterial{ConstantSpectrum{0}});
      shape.area_light = Id<AreaLight>{0};
      shape.flip_orientation = sides & 1;
      shape.object_to_world = translate({-1.5 + 0.6 * static_cast<double>(i), -1.2 + 0.8 * sides, 0}) *
                              rotate(0.6, {1, 0.3, 0}) * scale({0.25, 0.25, sides & 2 ? -0.3 : 0.3});
    }
  Diagnostics diagnostics;
  const PovPicture picture = render_povray(scene, folder_, &diagnostics);
  const auto of_triangles = [](const Diagnostic& d) {
    return d.message.find("becomes triangles, 256 for a full turn") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(diagnostics, of_triangles), 2) << "of the last two kinds, once a place";
  for (TriangleMesh& mesh : scene.meshes) mesh = tessellate(*mesh.quadric);
  const PovPicture expected = render_povray(scene, folder_);
  ASSERT_EQ(picture.values.size(), expected.values.size());
  ASSERT_FALSE(picture.values.empty());
  int shining = 0, differ = 0;
  for (std::size_t i = 0; i < picture.values.size(); i += 3) {
    shining += expected.values[i] > 0.5;
    differ += std::abs(picture.values[i] - expected.values[i]) > 0.01;
  }
  EXPECT_GT(shining, 500);
  EXPECT_LE(differ, 10) << "pixels on outlines";
}

// A sheaf of curves, bent and straight, to a point and not, as sweeps and as fine tubes.
TEST_F(PovrayOracle, CurvesAreTheirTubes) {
  const auto pictures = [&](bool straight, const Transform& t) {
    std::vector<PlacedCurve> curves;
    for (int i = 0; i < 7; ++i) {
      const double x = 1.2 * i - 3.6, r = .2 + .05 * (i % 3), bend = straight ? .3 : 1;
      const std::vector<CurvePoint> points{{{x, -6, .5}, r},
                                           {{x + .5 * bend, -2, .5 + 1.5 * bend}, r},
                                           {{x - .5 * bend, 2, .5 + .5 * bend}, r / 2},
                                           {{x, 6, .5}, i % 2 ? r : 0}};
      const auto next =
          placed_curves(straight ? linear_segments(points) : bezier_segments(points), 0, 1, straight, true);
      curves.insert(curves.end(), next.begin(), next.end());
    }
    std::vector<PovPicture> seen;
    for (const bool tubes : {false, true}) {
      Scene scene = plane();
      scene.lights.push_back({PointLight{{1, 0, 9}, Spectrum{ConstantSpectrum{60}}}});
      scene.shapes.push_back(test::add_curves(scene, curves, QuadricUv::pbrt));
      scene.shapes.back().material = {0};
      scene.shapes.back().object_to_world = t;
      scene.shapes.back().flip_orientation = swaps_handedness(t);
      TriangleMesh& mesh = scene.meshes.back();
      if (tubes) mesh = tessellate(*mesh.quadric, *mesh.places, 64);
      Diagnostics diagnostics;
      seen.push_back(render_povray(scene, folder_, &diagnostics));
      for (const Diagnostic& d : diagnostics) EXPECT_THAT(d.message, testing::HasSubstr("half a ball"));
      EXPECT_EQ(diagnostics.size(), !tubes && !straight ? 1u : 0u);
    }
    return seen;
  };
  for (const bool straight : {false, true}) {
    const std::vector<PovPicture> seen = pictures(straight, straight ? scale({-1, 1, 1}) : Transform{});
    ASSERT_EQ(seen[0].values.size(), seen[1].values.size());
    double difference = 0, sum = 0, plain = 0;
    for (std::size_t i = 0; i < seen[0].values.size(); ++i) {
      difference += std::abs(seen[0].values[i] - seen[1].values[i]);
      plain += seen[0].values[i] - seen[1].values[i];
      sum += seen[1].values[i];
    }
    EXPECT_LT(difference, 0.02 * sum) << straight;
    EXPECT_LT(std::abs(plain), 0.01 * sum) << straight;
  }
}

TEST_F(PovrayOracle, SurfacesThatReflectAndShine) {
  Scene scene = plane();
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi / 2, pi / 2, pi / 2})}});
  scene.area_lights.push_back({emission_from_rgb({.1, .2, .3})});
  scene.shapes[0].area_light = Id<AreaLight>{0};
  expect_plane(scene, [](double, double) -> std::array<double, 3> { return {.4 + .1, .25 + .2, .125 + .3}; });
}

TEST_F(PovrayOracle, ConstantEnvironmentByRadiosity) {
  Scene scene = plane();
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.5, .75, 1})}});
  expect_plane(
      scene,
      [](double, double) -> std::array<double, 3> {
        return {.8 * .5, .5 * .75, .25 * 1};
      },
      0.02);
}

// A disk of radius 1 at height 2 over the middle: E = πL·r²/(r² + h²) there.
TEST_F(PovrayOracle, LightsThatAreNoRectanglesByRadiosity) {
  Scene scene = plane();
  TriangleMesh disk;
  disk.positions.push_back({0, 0, 2});
  constexpr std::uint32_t n = 64;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double phi = 2 * pi * i / n;
    disk.positions.push_back({static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi)), 2});
    disk.triangles.push_back({0, 1 + (i + 1) % n, 1 + i});
  }
  add_emitter(scene, disk, {1, 1, 1});
  // Seen from below the disk.
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = translate({0, 0, -2.5}) * camera.camera_to_world;
  camera.screen = {-.1, .1, -.1, .1};
  const PovPicture picture = render_povray(scene, folder_);
  ASSERT_FALSE(picture.values.empty());
  EXPECT_NEAR(picture.at(16, 16)[0], .8 / 5, .05 * .8 / 5);
}

// In a closed box of radiance e and reflectance ρ all is e/(1 − ρ).
TEST_F(PovrayOracle, LightBetweenSurfacesByRadiosity) {
  Scene scene = empty_povray_scene();
  TriangleMesh box;
  box.positions = {{-3, -3, -3}, {3, -3, -3}, {-3, 3, -3}, {3, 3, -3},
                   {-3, -3, 3},  {3, -3, 3},  {-3, 3, 3},  {3, 3, 3}};
  box.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 5, 1}, {0, 4, 5},
                   {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  add_emitter(scene, box, {.25, .25, .25});
  scene.materials[0].model = DiffuseMaterial{ConstantSpectrum{.5f}};
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = translate({0, 0, -3}) * camera.camera_to_world;
  scene.settings.max_depth = 5;
  scene.film.width = scene.film.height = 12;
  scene.film.crop = {0, 12, 0, 12};
  const PovPicture picture = render_povray(scene, folder_);
  ASSERT_FALSE(picture.values.empty());
  for (const int x : {1, 6, 11}) EXPECT_NEAR(picture.at(x, 4)[1], .5, .03 * .5);
}

// What POV-Ray's absolute tolerances, and its floats far from the origin, would spoil.
TEST_F(PovrayOracle, SmallAndDistantScenes) {
  for (const auto& [size, place] : {std::pair{1e-4, 0.0}, {1.0, 1e6}, {1e6, 0.0}}) {
    Scene scene = plane();
    const Transform t = translate({place, place, 0}) * vitrail::scale({size, size, size});
    scene.shapes[0].object_to_world = t;
    auto& camera = std::get<PerspectiveCamera>(scene.camera);
    camera.camera_to_world = t * camera.camera_to_world;
    scene.lights.push_back(
        {PointLight{transform_point(t, {.5, -.25, 1.5}), emission_from_rgb(RGB{4 * size * size, 0, 0})}});
    expect_plane(scene, [](double x, double y) -> std::array<double, 3> {
      const double dx = x - .5, dy = y + .25, d2 = dx * dx + dy * dy + 2.25;
      return {4 * .8 * 1.5 / std::sqrt(d2) / d2 / pi, 0, 0};
    });
  }
}

TEST_F(PovrayOracle, Mirror) {
  Scene scene = empty_povray_scene();
  add(scene, square(-5, 5, -5, 5, 0), ConductorMaterial{PerfectReflector{}});
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.5, .75, 1})}});
  scene.settings.max_depth = 3;
  expect_plane(
      scene,
      [](double, double) -> std::array<double, 3> {
        return {.5, .75, 1};
      },
      0.002);
}

// Glass absorbs nothing: in a sky of one colour it cannot be seen.
TEST_F(PovrayOracle, GlassInAFurnace) {
  Scene scene = empty_povray_scene();
  TriangleMesh slab = square(-5, 5, -5, 5, 0), below = square(-5, 5, -5, 5, -1);
  for (auto& t : below.triangles) std::swap(t[1], t[2]);
  for (auto& t : below.triangles) slab.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  slab.positions.insert(slab.positions.end(), below.positions.begin(), below.positions.end());
  slab.uvs.insert(slab.uvs.end(), below.uvs.begin(), below.uvs.end());
  add(scene, slab, DielectricMaterial{});
  scene.lights.push_back({InfiniteLight{emission_from_rgb({.5, .5, .5})}});
  scene.settings.max_depth = 20;
  expect_plane(
      scene,
      [](double, double) -> std::array<double, 3> {
        return {.5, .5, .5};
      },
      0.01);
}

// ---- Places -------------------------------------------------------------------------------------

// A lamp in the upper right quarter of the picture.
Scene corner_lamp() {
  Scene scene = empty_povray_scene();
  add_emitter(scene, square(.2f, 1.8f, .2f, 1.8f, 0), {1, 0, 0});
  return scene;
}

TEST_F(PovrayOracle, CameraOfEitherHandedness) {
  Scene scene = corner_lamp();
  EXPECT_EQ(quarters(scene), (Colors{black, red, black, black}));
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = camera.camera_to_world * scale({-1, 1, 1});
  EXPECT_EQ(quarters(scene), (Colors{red, black, black, black}));
  camera.camera_to_world = camera.camera_to_world * rotate(pi / 2, {0, 0, 1});
  EXPECT_EQ(std::ranges::count(quarters(scene), red), 1);
  camera.camera_to_world = camera.camera_to_world * scale({1, -1, 1}) * rotate(-pi / 2, {0, 0, 1});
  EXPECT_EQ(std::ranges::count(quarters(scene), red), 1);
}

TEST_F(PovrayOracle, ScreenWindowsAndOrthographicCameras) {
  Scene scene = corner_lamp();
  std::get<PerspectiveCamera>(scene.camera).screen = {0, .5, -.5, 0};  // the lower right quarter
  EXPECT_EQ(quarters(scene), (Colors{black, black, black, black}));
  std::get<PerspectiveCamera>(scene.camera).screen = {0, .5, 0, .5};
  EXPECT_EQ(quarters(scene), (Colors{red, red, red, red}));
  OrthographicCamera camera;
  camera.camera_to_world = std::get<PerspectiveCamera>(scene.camera).camera_to_world;
  camera.screen = {-2, 2, -2, 2};
  scene.camera = camera;
  EXPECT_EQ(quarters(scene), (Colors{black, red, black, black}));
  camera.screen = {0, 2, -2, 2};
  scene.camera = camera;
  EXPECT_EQ(quarters(scene), (Colors{red, red, black, black}));
}

// Latitude and longitude as in pbrt: from the left edge, +x, +z, −x, −z; +y at the top.
TEST_F(PovrayOracle, SphericalCameras) {
  for (const Transform& turn :
       {Transform{}, scale({-1, 1, 1}), rotate(1, {1, 2, 3}), rotate(1, {1, 2, 3}) * scale({1, 1, -1})}) {
    Scene scene = empty_povray_scene();
    SphericalCamera camera;
    camera.camera_to_world = turn;
    camera.projection = SphericalCamera::Projection::latitude_longitude;
    scene.camera = camera;
    TriangleMesh lamp = quad_mesh({3, 1, .5f}, {1, 1, 3}, {1, 3, 3}, {3, 3, .5f});
    add_emitter(scene, lamp, {1, 0, 0}).object_to_world = turn;
    scene.area_lights[0].two_sided = true;
    const PovPicture picture = render_povray(scene, folder_);
    ASSERT_FALSE(picture.values.empty());
    const auto at = [&](Vector3d d) {
      double u = std::atan2(d.z, d.x) / (2 * pi);
      if (u < 0) u += 1;
      return picture.at(static_cast<int>(u * 32), static_cast<int>(std::acos(d.y / length(d)) / pi * 32));
    };
    EXPECT_EQ(at({2, 2, 1.75}), red);
    EXPECT_EQ(at({2, -2, 1.75}), black);
    EXPECT_EQ(at({-2, 2, 1.75}), black);
    EXPECT_EQ(at({2, 2, -1.75}), black);
  }
}

// An edge far behind the plane in focus is blurred as far as the lens is wide, seen from that plane.
TEST_F(PovrayOracle, LensesBlur) {
  Scene scene = empty_povray_scene();
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = {};
  camera.lens = {.25, 1};
  add_emitter(scene, square(-1e3f, 0, -1e3f, 1e3f, 1e3f), {1, 0, 0});
  scene.area_lights[0].two_sided = true;
  const PovPicture picture = render_povray(scene, folder_);
  ASSERT_FALSE(picture.values.empty());
  double mean = 0, variance = 0;
  for (int x = 1; x < 32; ++x) {
    const double weight = picture.at(x - 1, 16)[0] - picture.at(x, 16)[0], at = (x - 16) / 32.0;
    mean += weight * at;
    variance += weight * at * at;
  }
  EXPECT_NEAR(mean, 0, .01);
  EXPECT_NEAR(2 * std::sqrt(variance), .25, .02);  // the deviation of a disk is half its radius
}

TEST_F(PovrayOracle, OptionsOfTheFilm) {
  Scene scene = corner_lamp();
  scene.film.width = 40;
  scene.film.height = 20;
  scene.film.crop = {0, 40, 0, 10};
  const PovPicture picture = render_povray(scene, folder_);
  EXPECT_EQ(picture.width, 40);
  EXPECT_EQ(picture.height, 20);
  EXPECT_EQ(picture.at(30, 5), red);
}

TEST_F(PovrayOracle, ImagesLieWithTheirLowerLeftCornerAtZero) {
  folder_.write("image.ppm", "P3\n2 2\n255\n255 0 0  0 255 0  0 0 255  255 255 255\n");
  Scene scene = empty_povray_scene();
  scene.textures.push_back({ImageTexture{(folder_ / "image.ppm").string()}});
  std::get<ImageTexture>(scene.textures[0].model).filter = TextureFilter::nearest;
  add(scene, square(-2, 2, -2, 2, 0), DiffuseMaterial{Id<Texture>{0}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
  const auto near = [&](const Colors& expected) {
    const Colors seen = quarters(scene);
    ASSERT_EQ(seen.size(), 4u);
    for (std::size_t q = 0; q < 4; ++q)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[q][c], expected[q][c], 2e-3) << q << ' ' << c;
  };
  near({red, green, blue, white});
  auto& mapping = std::get<UvMapping>(std::get<ImageTexture>(scene.textures[0].model).mapping);
  mapping = {1, 0, 0, 0, -1, 1};  // t = 1 − v
  near({blue, white, red, green});
  mapping = {1, 0, .5f, 0, 1, 0};  // s = u + ½
  near({green, red, white, blue});
  mapping = {.25f, 0, 0, 0, .5f, .5f};  // the upper left corner of the image
  near({red, red, red, red});
  mapping = {0, 1, 0, 1, 0, 0};  // s = v, t = u
  near({white, green, blue, red});
  mapping = {};
  scene.meshes[0].uvs.clear();  // pbrt's own: (0,0), (1,0), (1,1) for each triangle
  near({white, green, blue, white});
}

// POV-Ray would see through them.
TEST_F(PovrayOracle, ColorsUnderTransparentAlphaStay) {
  test::write_png(folder_ / "image.png", 2, 2, 4,
                  {255, 0, 0, 0, 0, 255, 0, 128, 0, 0, 255, 255, 255, 255, 255, 0});
  Scene scene = empty_povray_scene();
  scene.textures.push_back({ImageTexture{(folder_ / "image.png").string()}});
  std::get<ImageTexture>(scene.textures[0].model).filter = TextureFilter::nearest;
  add(scene, square(-2, 2, -2, 2, 0), DiffuseMaterial{Id<Texture>{0}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
  const Colors seen = quarters(scene), expected{red, green, blue, white};
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[q][c], expected[q][c], 2e-3) << q << ' ' << c;
}

// A blend by the blue channel of an image, which POV-Ray would take for its grey.
TEST_F(PovrayOracle, NumbersAreOfTheirChannel) {
  test::write_png(folder_ / "image.png", 2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
  Scene scene = empty_povray_scene();
  ImageTexture image{(folder_ / "image.png").string()};
  image.number = ImageNumber::blue;
  scene.textures.push_back({image, true});
  scene.textures.push_back(
      {MixTexture{SpectrumParameter{ConstantSpectrum{0}}, SpectrumParameter{ConstantSpectrum{1}},
                  FloatParameter{Id<Texture>{0}}}});
  add(scene, square(-2, 2, -2, 2, 0), DiffuseMaterial{Id<Texture>{1}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
  const Colors seen = quarters(scene);
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t q = 0; q < 4; ++q) EXPECT_NEAR(seen[q][0], q < 2 ? 0 : 1, 0.05) << q;
}

TEST_F(PovrayOracle, ProductsOfTextures) {
  folder_.write("image.ppm", "P3\n2 2\n255\n255 0 0  0 255 0  0 0 255  255 255 255\n");
  Scene scene = empty_povray_scene();
  ImageTexture image{(folder_ / "image.ppm").string()};
  image.filter = TextureFilter::nearest;
  scene.textures.push_back({image});
  scene.textures.push_back(
      {ProductTexture{SpectrumParameter{unbounded_from_rgb({.25, .5, .75})}, Id<Texture>{0}}});
  add(scene, square(-2, 2, -2, 2, 0), DiffuseMaterial{Id<Texture>{1}});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
  const Colors seen = quarters(scene);
  ASSERT_EQ(seen.size(), 4u);
  const Colors expected{{.25, 0, 0}, {0, .5, 0}, {0, 0, .75}, {.25, .5, .75}};
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[q][c], expected[q][c], 2e-3);
}

TEST_F(PovrayOracle, InstancesAndTheirMeshFiles) {
  Scene scene = empty_povray_scene();
  TriangleMesh many = square(.1f, .2f, .1f, .2f, 0);
  while (many.triangles.size() < 100) many.triangles.push_back(many.triangles[many.triangles.size() % 2]);
  Shape shape = make_shape(scene, many, DiffuseMaterial{ConstantSpectrum{1}});
  shape.object_to_world = scale({10, 10, 1});  // 1 … 2
  scene.prototypes.push_back({"p", {shape}});
  const Transform half = translate({-.5, -.5, 0});
  scene.instances.push_back({{0}, half});
  scene.instances.push_back({{0}, scale({-1, -1, 1}) * half});
  scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
  const Colors seen = quarters(scene);
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_NEAR(seen[1][0], 1, 1e-3);
  EXPECT_NEAR(seen[2][1], 1, 1e-3);
  EXPECT_EQ(seen[0], black);
  EXPECT_EQ(seen[3], black);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "scene-meshes" / "000000.inc"));
}

// An image of the whole sphere in which each octant of directions has its own colour.
std::array<double, 3> octant_color(Vector3d d) {
  return {d.x > 0 ? 1.0 : 0.0, d.y > 0 ? 1.0 : 0.0, d.z > 0 ? 1.0 : 0.0};
}

template <class Direction>
std::string sphere_image(int width, int height, Direction&& direction) {
  std::string text = fmt::format("P3\n{} {}\n255\n", width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto c = octant_color(direction((x + .5) / width, (y + .5) / height));
      text += fmt::format("{:.0f} {:.0f} {:.0f}\n", c[0] * 255, c[1] * 255, c[2] * 255);
    }
  return text;
}

// Clarberg 2008: from the square to the sphere, u right and v down the image.
Vector3d equal_area_direction(double px, double py) {
  const double u = 2 * px - 1, v = 2 * py - 1, up = std::abs(u), vp = std::abs(v);
  const double signed_distance = 1 - (up + vp), d = std::abs(signed_distance), r = 1 - d;
  const double phi = (r == 0 ? 1 : (vp - up) / r + 1) * pi / 4;
  const double z = std::copysign(1 - r * r, signed_distance), s = r * std::sqrt(std::max(0.0, 2 - r * r));
  return {std::copysign(std::cos(phi), u) * s, std::copysign(std::sin(phi), v) * s, z};
}

TEST_F(PovrayOracle, EnvironmentsFaceTheRightWay) {
  folder_.write("square.ppm", sphere_image(64, 64, equal_area_direction));
  folder_.write("map.ppm", sphere_image(64, 32, [](double u, double v) -> Vector3d {
                  const double phi = 2 * pi * u, theta = pi * v;
                  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
                }));
  const Transform turned = rotate(.7, {1, 2, 3}) * scale({1, 1, -1});
  for (const bool is_map : {true, false})
    for (const Transform& light_to_world : {Transform{}, turned}) {
      Scene scene = empty_povray_scene();
      scene.settings.max_depth = 0;
      EnvironmentLight light;
      light.filename = (folder_ / (is_map ? "map.ppm" : "square.ppm")).string();
      light.light_to_world = light_to_world;
      if (is_map) light.projection = EnvironmentLight::Projection::latitude_longitude;
      scene.lights.push_back({light});
      for (const Vector3d view : {Vector3d{1, 2, -3}, {-1, -1, 2}, {-2, 3, 1}}) {
        auto& camera = std::get<PerspectiveCamera>(scene.camera);
        camera.camera_to_world = look_at({}, Point3d{} + transform_vector(light_to_world, view), {0, .1, 1});
        camera.screen = {-.01, .01, -.01, .01};
        const PovPicture picture = render_povray(scene, folder_);
        ASSERT_FALSE(picture.values.empty());
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(picture.at(16, 16)[c], octant_color(view)[c], .02)
              << is_map << ' ' << view.x << ' ' << view.y << ' ' << view.z << ' ' << c;
      }
    }
}

}  // namespace
}  // namespace vitrail::povray_oracle_test
