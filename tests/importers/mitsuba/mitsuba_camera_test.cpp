// SPDX-License-Identifier: Apache-2.0
// Cameras, films and integrators as Mitsuba 3 reads them from written files.
#include <cmath>

#include "scene/geometry/pi.h"
#include "tests/importers/mitsuba/mitsuba_oracle.h"

namespace vitrail::mitsuba_camera_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct Ray {
  Point3d o;
  Vector3d d;
};

// The Scene's ray through (x,y) in [0,1]² of the cropped picture.
Ray expected_ray(const Scene& scene, double x, double y) {
  const FilmSettings& film = scene.film;
  const double u = (film.crop.x0 + x * (film.crop.x1 - film.crop.x0)) / film.width,
               v = (film.crop.y0 + y * (film.crop.y1 - film.crop.y0)) / film.height;
  const auto on_screen = [&](const ScreenWindow& s) {
    return Point3d{s.x0 + u * (s.x1 - s.x0), s.y1 - v * (s.y1 - s.y0), 0};
  };
  if (const auto* camera = std::get_if<OrthographicCamera>(&scene.camera))
    return {transform_point(camera->camera_to_world, on_screen(camera->screen)),
            normalize(transform_vector(camera->camera_to_world, {0, 0, 1}))};
  const auto& camera = std::get<PerspectiveCamera>(scene.camera);
  const Point3d p = on_screen(camera.screen);
  return {transform_point(camera.camera_to_world, {0, 0, 0}),
          normalize(transform_vector(camera.camera_to_world, {p.x, p.y, 1}))};
}

class MitsubaCamera : public MitsubaOracle {
 protected:
  void expect_rays(const Scene& scene) {
    const std::vector<std::array<double, 2>> points{{0, 0}, {1, 0}, {0.25, 0.75}, {1, 1}};
    const Json answer = ask(scene, {{{"op", "camera"}, {"points", points}}}).at(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Ray ray = expected_ray(scene, points[i][0], points[i][1]);
      expect_near(answer.at(i).at("d"), {ray.d.x, ray.d.y, ray.d.z}, 1e-5, "direction");
      const auto& o = answer.at(i).at("o");  // moved to the near plane
      const Vector3d along{o[0].get<double>() - ray.o.x, o[1].get<double>() - ray.o.y,
                           o[2].get<double>() - ray.o.z};
      EXPECT_LT(length(cross(along, ray.d)), 1e-5) << "origin of ray " << i;
    }
  }
};

TEST_F(MitsubaCamera, Perspective) {
  Scene scene = square_scene({});
  std::get<PerspectiveCamera>(scene.camera).camera_to_world = look_at({3, 2, 5}, {0.5, 0, 0}, {0, 1, 0.2});
  expect_rays(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaCamera, OffCentreWindowAndCrop) {
  Scene scene = square_scene({});
  std::get<PerspectiveCamera>(scene.camera).screen = {-0.3, 0.7, -0.4, 0.1};
  scene.film.crop = {2, 6, 1, 3};
  expect_rays(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaCamera, TallPictureWithTheAngleOnItsWidth) {
  Scene scene = square_scene({});
  scene.film.width = 3, scene.film.height = 7, scene.film.crop = {0, 3, 0, 7};
  const double x = std::tan(20 * pi / 180);
  std::get<PerspectiveCamera>(scene.camera).screen = {-x, x, -x * 7 / 3, x * 7 / 3};
  expect_rays(scene);
  EXPECT_THAT(text(), HasSubstr(R"(name="fov" value="40")"));
}

TEST_F(MitsubaCamera, ScaledAndMirrored) {
  Scene scene = square_scene({});
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.camera_to_world = camera.camera_to_world * scale({-2, 2, 4});
  expect_rays(scene);
}

TEST_F(MitsubaCamera, Orthographic) {
  Scene scene = square_scene({});
  scene.camera = OrthographicCamera{look_at({3, 2, 5}, {0.5, 0, 0}, {0, 1, 0.2}), {-1, 1, -0.5, 0.5}, {}};
  expect_rays(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaCamera, OrthographicWithAnyWindow) {
  Scene scene = square_scene({});
  scene.camera = OrthographicCamera{look_at({3, 2, 5}, {0.5, 0, 0}, {0, 1, 0.2}), {-2, 5, -1, 0.5}, {}};
  expect_rays(scene);
}

TEST_F(MitsubaCamera, ThinLens) {
  Scene scene = square_scene({});
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.lens = {0.25, 4};
  const Json points{{0.25, 0.25}};
  const Json answer = ask(scene, {{{"op", "camera"}, {"points", points}, {"aperture", {0.5, 0.5}}},
                                  {{"op", "camera"}, {"points", points}, {"aperture", {0.9, 0.3}}}});
  const Ray centre = expected_ray(scene, 0.25, 0.25);
  const double t = 4 / -centre.d.z;  // both rays meet in the plane of focus
  for (const Json& found : answer) {
    const auto &o = found[0].at("o"), &d = found[0].at("d");
    const double s = (1 - o[2].get<double>()) / d[2].get<double>();
    EXPECT_NEAR(o[0].get<double>() + s * d[0].get<double>(), centre.o.x + t * centre.d.x, 1e-4);
    EXPECT_NEAR(o[1].get<double>() + s * d[1].get<double>(), centre.o.y + t * centre.d.y, 1e-4);
  }
  EXPECT_GT(std::abs(answer[1][0]["o"][0].get<double>() - answer[0][0]["o"][0].get<double>()), 0.05);
}

TEST_F(MitsubaCamera, NothingNearOrFarIsCutAway) {
  Scene scene = square_scene({});
  scene.shapes[0].object_to_world = translate({0, 0, -1e6}) * scale({1e6, 1e6, 1});
  const Json answer =
      ask(scene, {{{"op", "camera"}, {"points", {{0.5, 0.5}}}}, ray("hit", {0, 0, 5}, {0, 0, -1})});
  EXPECT_LT(5 - answer[0][0]["o"][2].get<double>(), 0.1);
  EXPECT_NE(text().find(R"(name="far_clip" value="10000000")"), std::string::npos) << text();
}

// Each band is the mean radiance of its interval.
TEST_F(MitsubaOracle, BinsAreBandsOfMeanRadiance) {
  Scene scene = empty_scene();
  scene.film.spectrum = {3, 400, 700};
  scene.film.filter = BoxFilter{};
  const Spectrum steps = tabulate({{300, 1}, {500, 1}, {500.5, 3}, {900, 3}}, true);
  scene.lights = {{InfiniteLight{steps}}};
  const Json picture = ask(scene, {{{"op", "render"}, {"spp", 1024}}}).at(0);
  expect_near(picture.at("shape"), {4, 8, 3}, 0);
  expect_near(picture.at("mean"), {1, 3, 3}, 0.02);
  EXPECT_THAT(diagnostics_, testing::SizeIs(1));
}

TEST_F(MitsubaOracle, FilmAndIntegrator) {
  Scene scene = square_scene({});
  scene.film.crop = {2, 6, 1, 3};
  scene.film.filter = GaussianFilter{1.6, 1.6, 0.4};
  scene.settings = {77, 9, false};
  const Json film = ask(scene, {{{"op", "film"}}}).at(0);
  expect_near(film.at("size"), {8, 4}, 0);
  expect_near(film.at("crop_offset"), {2, 1}, 0);
  expect_near(film.at("crop_size"), {4, 2}, 0);
  EXPECT_THAT(film.at("filter").get<std::string>(), HasSubstr("stddev=0.40, radius=1.60"));
  EXPECT_EQ(film.at("samples"), 77);
  EXPECT_THAT(film.at("integrator").get<std::string>(), HasSubstr("max_depth = 10"));
  for (const Filter& filter : {Filter{BoxFilter{}}, Filter{TriangleFilter{1.5, 1.5}},
                               Filter{MitchellFilter{}}, Filter{SincFilter{3, 3, 3}}}) {
    scene.film.filter = filter;
    scene.settings.direct_only = true;
    ask(scene, Json::array());
  }
}

}  // namespace
}  // namespace vitrail::mitsuba_camera_test
