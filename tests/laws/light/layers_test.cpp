// SPDX-License-Identifier: Apache-2.0
// What a film keeps of the first surfaces, where it is known in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/laws/light/flat_scenes.h"

namespace vitrail::test::layers_test {
namespace {

// Of all pixels of a plane of a layer, with the standard error of that mean.
struct Value {
  double mean = 0, error = 0;
};

Value value_of(const Film& film, Layer layer, std::size_t plane = 0) {
  Value v;
  double squares = 0;
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    const double x = film.mean_of_layer(p, layer, plane);
    v.mean += x / film.pixels();
    squares += x * x / film.pixels();
  }
  v.error = std::sqrt(std::max(0.0, squares - v.mean * v.mean) / (film.pixels() - 1));
  return v;
}

void expect_value(const Film& film, Layer layer, std::size_t plane, double expected, double slack,
                  const std::string& what = "") {
  const Value v = value_of(film, layer, plane);
  EXPECT_NEAR(v.mean, expected, 4.5 * v.error + slack) << what << " " << kind_of(layer).name << " " << plane;
}
void expect_vector(const Film& film, Layer layer, Vector3d expected, double slack,
                   const std::string& what = "") {
  for (int i = 0; i < 3; ++i)
    expect_value(film, layer, static_cast<std::size_t>(i), expected[i], slack, what);
}

RGB albedo_of(const Film& film) {
  return xyz_to_srgb({value_of(film, Layer::albedo, 0).mean, value_of(film, Layer::albedo, 1).mean,
                      value_of(film, Layer::albedo, 2).mean});
}
void expect_albedo(const Film& film, RGB expected, double slack, const std::string& what) {
  const RGB c = albedo_of(film);
  EXPECT_NEAR(c.r, expected.r, slack) << what;
  EXPECT_NEAR(c.g, expected.g, slack) << what;
  EXPECT_NEAR(c.b, expected.b, slack) << what;
}
void expect_grey(const Film& film, double expected, double slack, const std::string& what) {
  expect_albedo(film, {expected, expected, expected}, slack, what);
}

Film layers_of(Scene& scene, int samples = 64, bool in_camera_space = false) {
  scene.film.layers = {all_layers, in_camera_space};
  return render(scene, samples).film;
}

Material grey(float reflectance) { return {DiffuseMaterial{ConstantSpectrum{reflectance}}}; }

TEST(Layers, OfAPlane) {
  for (const double theta : {0.0, 40.0, 140.0}) {
    const bool front = theta < 90;
    const std::string what = fmt::format("{}°", theta);
    Scene scene;
    Material half = grey(0.5f);
    half.two_sided = true;
    add_shape(scene, square(scene, 0, 2), half);
    scene.meshes[0].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    look_along(scene, direction(theta, 30), {0.5, -1, 0});
    const Film film = layers_of(scene);
    expect_vector(film, Layer::geometric_normal, {0, 0, front ? 1.0 : -1.0}, 1e-9, what);
    expect_vector(film, Layer::shading_normal, {0, 0, front ? 1.0 : -1.0}, 1e-9, what);
    expect_vector(film, Layer::position, {0.5, -1, 0}, 1e-4, what);
    expect_value(film, Layer::depth, 0, 20, 1e-4, what);
    expect_value(film, Layer::uv, 0, 2.5 / 4, 1e-4, what);
    expect_value(film, Layer::uv, 1, 1.0 / 4, 1e-4, what);
    expect_grey(film, 0.5, 5e-4, what);
    for (std::uint32_t p = 0; p < film.pixels(); ++p) {
      ASSERT_EQ(film.id(p, Layer::shape), 1u);
      ASSERT_EQ(film.id(p, Layer::material), 1u);
      ASSERT_GE(film.id(p, Layer::primitive), 1u);
      ASSERT_LE(film.id(p, Layer::primitive), 2u);
    }
  }
}

// Each pixel by itself: the depth of its middle, with a plane that falls away from the camera.
TEST(Layers, DepthIsAlongTheRay) {
  Scene scene;
  add_shape(scene, square(scene, 0), grey(0.5f));
  set_camera(scene, {0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 1.2, 9, 5);
  const Film film = layers_of(scene, 256);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 9; ++x) {
      const auto p = static_cast<std::uint32_t>(9 * y + x);
      const double tangent = std::tan(0.6), u = (2 * x - 8) / 5.0 * tangent, v = (2 * y - 4) / 5.0 * tangent;
      // The mean over a pixel is more than the middle by half of the second derivatives times its variance.
      EXPECT_NEAR(film.mean_of_layer(p, Layer::depth, 0), 3 * std::sqrt(1 + u * u + v * v), 0.02);
      EXPECT_NEAR(std::abs(film.mean_of_layer(p, Layer::position, 0)), std::abs(3 * u), 0.01);
      EXPECT_NEAR(std::abs(film.mean_of_layer(p, Layer::position, 1)), std::abs(3 * v), 0.01);
    }
}

TEST(Layers, OfTheCamera) {
  Scene scene;
  add_shape(scene, square(scene, 0), grey(0.5f));
  look_along(scene, direction(40, 30));
  const Film film = layers_of(scene, 64, true);
  expect_vector(film, Layer::position, {0, 0, 20}, 1e-3);
  for (const Layer layer : {Layer::geometric_normal, Layer::shading_normal}) {
    const double x = value_of(film, layer, 0).mean, y = value_of(film, layer, 1).mean,
                 z = value_of(film, layer, 2).mean;
    EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-9);
    EXPECT_NEAR(z, -std::cos(40 * std::numbers::pi / 180), 1e-9)
        << "it faces the camera, which looks along +z";
  }
}

// The bundle has an origin of its own.
TEST(Layers, PositionsAreOfTheWorld) {
  Scene scene;
  const Vector3d far{1e6, -3e5, 7e4};
  add_shape(scene, square(scene, 0, 4), grey(0.5f));
  scene.shapes[0].object_to_world = translate(far);
  look_along(scene, {0, 0, 1}, Point3d{} + far);
  expect_vector(layers_of(scene), Layer::position, far, 1e-4);
}

TEST(Layers, OfInstancesAsTheyStand) {
  const Transform placed =
      translate({1, 2, 3}) * rotate(0.7, {1, 2, -1}) * scale({3, 0.5, 2}) * rotate(0.3, {0, 1, 0});
  for (const Transform& t : {placed, placed * scale({-1, 1, 1})}) {
    Scene scene;
    const Id<TriangleMesh> mesh = square(scene, 0, 5);
    // Shading normals that lean over.
    scene.meshes[0].normals.assign(4, {0.6f, 0, 0.8f});
    scene.materials.push_back(grey(0.5f));
    scene.prototypes.push_back({"card", {Shape{mesh, {0}}}});
    scene.instances.push_back({Id<Prototype>{0}, t});
    scene.instances.push_back({Id<Prototype>{0}, translate({0, 0, 300})});
    const Normal3d n = transform_normal(t, {0, 0, 1}), s = transform_normal(t, {0.6, 0, 0.8});
    const Vector3d normal = normalize(to_vector(n)), leaning = normalize(to_vector(s));
    const Vector3d out = dot(normal, leaning) > 0 ? normalize(normal + leaning) : normal;
    look_along(scene, out, {1, 2, 3});
    const Film film = layers_of(scene);
    // Vertices and coded normals are rounded.
    const double side = dot(normal, out) > 0 ? 1 : -1;
    expect_vector(film, Layer::geometric_normal, normal * side, 1e-5);
    expect_vector(film, Layer::shading_normal, leaning * side, 2e-4);
    expect_vector(film, Layer::position, {1, 2, 3}, 1e-3);
  }
}

// Whatever is not there is passed, and counts for nothing.
TEST(Layers, OfWhatIsThere) {
  for (const bool counts : {false, true})
    for (const int what : {0, 1, 2}) {
      Scene scene;
      scene.settings.straight_counts = counts;
      add_shape(scene, square(scene, 0), grey(0.8f));
      if (what == 0) {
        add_shape(scene, square(scene, 1), grey(0.2f));
        scene.shapes.back().opacity = 0.25f;
      } else if (what == 1) {
        scene.materials.push_back(grey(0.2f));
        add_shape(scene, square(scene, 1), Material{MaskMaterial{0.25f, {1}}});
      } else {
        add_shape(scene, square(scene, 1), Material{InterfaceMaterial{}});
      }
      look_along(scene, {0, 0, 1});
      const Film film = layers_of(scene, 256);
      const std::string name = fmt::format("{} {}", what, counts);
      const double share = what == 2 ? 0 : 0.25;
      expect_value(film, Layer::position, 2, share, 1e-4, name);
      expect_value(film, Layer::depth, 0, 20 - share, 1e-4, name);
      expect_value(film, Layer::geometric_normal, 2, 1, 1e-9, name);
      expect_grey(film, share * 0.2 + (1 - share) * 0.8, 4e-3, name);
      int upper = 0;
      for (std::uint32_t p = 0; p < film.pixels(); ++p) upper += film.id(p, Layer::shape) == 2;
      EXPECT_NEAR(upper, share * film.pixels(), 4.5 * std::sqrt(film.pixels() / 5.0) * (share > 0)) << name;
    }
}

TEST(Layers, OfNothing) {
  Scene scene;
  add_shape(scene, square(scene, 0), grey(0.5f));
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{1}}});
  look_along(scene, {0, 0, -1});
  OrthographicCamera& camera = std::get<OrthographicCamera>(scene.camera);
  camera.camera_to_world = look_at({0, 0, 20}, {0, 0, 40}, {0, 1, 0});
  const Film film = layers_of(scene, 4);
  EXPECT_GT(brightness(film).mean, 0.5);
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    for (std::size_t i = 0; i < layer_count; ++i) {
      const auto layer = static_cast<Layer>(i);
      for (std::size_t plane = 0; plane < kind_of(layer).sums; ++plane)
        ASSERT_EQ(film.mean_of_layer(p, layer, plane), 0);
      if (kind_of(layer).is_id()) {
        ASSERT_EQ(film.id(p, layer), 0u);
      }
      if (kind_of(layer).is_matte) {
        ASSERT_EQ(film.matte(p, layer), MattePixel{});
      }
    }
  }
}

// A sample that a medium scatters sees no surface.
TEST(Layers, OfWhatFogLeaves) {
  Scene scene;
  add_shape(scene, square(scene, 19), grey(0.5f));
  Medium fog;
  fog.coefficients = AbsorptionScattering{ConstantSpectrum{0}, ConstantSpectrum{0.7f}};
  scene.media.push_back(fog);
  scene.camera_medium = Id<Medium>{0};
  look_along(scene, {0, 0, 1});
  const Film film = layers_of(scene, 256);
  expect_value(film, Layer::geometric_normal, 2, std::exp(-0.7), 1e-4);
  expect_value(film, Layer::depth, 0, std::exp(-0.7), 1e-4);
}

TEST(Layers, DoNotNeedDepth) {
  Scene scene;
  add_shape(scene, square(scene, 0), grey(0.5f));
  look_along(scene, {0, 0, 1});
  scene.settings.max_depth = 0;
  const Film film = layers_of(scene);
  expect_grey(film, 0.5, 5e-4, "at depth 0");
  expect_value(film, Layer::depth, 0, 20, 1e-9);
}

// ---- Albedo

Film plane_of(const Material& material, double theta = 30, int samples = 64) {
  Scene scene;
  add_shape(scene, square(scene, 0), material);
  look_along(scene, direction(theta, 20));
  return layers_of(scene, samples);
}

TEST(LayersAlbedo, OfDiffuseColours) {
  for (const RGB c : {RGB{0.8, 0.3, 0.1}, RGB{0.05, 0.6, 0.9}, RGB{1, 1, 1}}) {
    const Film film = plane_of({DiffuseMaterial{reflectance_from_rgb(c)}});
    expect_albedo(film, c, 2e-3, fmt::format("{} {} {}", c.r, c.g, c.b));
  }
}

TEST(LayersAlbedo, OfGlassIsOne) {
  for (const float alpha : {0.0f, 0.1f}) {
    DielectricMaterial glass;
    glass.roughness.alpha_u = glass.roughness.alpha_v = alpha;
    // Rough glass loses what would meet a second facet: of facets that tilt much, as GGX has.
    expect_grey(plane_of({glass}), 1, alpha > 0 ? 0.02 : 5e-4, fmt::format("α {} from outside", alpha));
    expect_grey(plane_of({glass}, 160), 1, alpha > 0 ? 0.02 : 5e-4, fmt::format("α {} from inside", alpha));
    glass.transmittance_factor = ConstantSpectrum{0};
    glass.eta = ConstantSpectrum{1.5f};
    expect_grey(plane_of({glass}, 0), 0.04, alpha > 0 ? 2e-3 : 1e-4, "what it reflects");
  }
  expect_grey(plane_of({ThinDielectricMaterial{}}), 1, 5e-4, "a sheet");
}

TEST(LayersAlbedo, OfMetals) {
  ConductorMaterial mirror{PerfectReflector{}};
  expect_grey(plane_of({mirror}), 1, 5e-4, "mirror");
  mirror.metal = NormalReflectance{ConstantSpectrum{0.6f}};
  expect_grey(plane_of({mirror}, 0), 0.6, 5e-4, "metal");
  mirror.roughness.alpha_u = mirror.roughness.alpha_v = 0.05f;
  expect_grey(plane_of({mirror}, 0), 0.6, 5e-3, "rough metal");
}

TEST(LayersAlbedo, OfMixturesIsTheirMean) {
  Scene scene;
  scene.materials = {grey(0.9f), grey(0.1f)};
  add_shape(scene, square(scene, 0), Material{BlendMaterial{{0}, {1}, 0.25f}});
  look_along(scene, {0, 0, 1});
  expect_grey(layers_of(scene, 256), 0.7, 4e-3, "mixture");
  expect_grey(plane_of({DiffuseTransmissionMaterial{ConstantSpectrum{0.3f}, ConstantSpectrum{0.4f}}}), 0.7,
              1e-3, "reflected and transmitted");
  Material one_sided = grey(0.5f);
  one_sided.two_sided = false;
  expect_grey(plane_of(one_sided, 150), 0, 0, "the back of a one-sided surface");
}

// What is kept beside a picture does not change it: not even where a bundle holds (u,v) for it that no
// material asks for.
TEST(Layers, LeaveThePictureAsItIs) {
  ConductorMaterial metal, brushed;
  metal.roughness.alpha_u = metal.roughness.alpha_v = brushed.roughness.alpha_u = 0.3f;
  DielectricMaterial frosted;
  frosted.roughness.alpha_u = frosted.roughness.alpha_v = 0.3f;
  PrincipledMaterial principled;
  principled.roughness = 0.4f;
  const std::vector<MaterialModel> models{DiffuseMaterial{ConstantSpectrum{0.5f}},
                                          metal,
                                          brushed,
                                          frosted,
                                          DielectricMaterial{},
                                          ThinDielectricMaterial{},
                                          PlasticMaterial{},
                                          principled,
                                          CoatedDiffuseMaterial{},
                                          DiffuseTransmissionMaterial{}};
  const auto picture = [&](FilmLayers layers) {
    Scene scene;
    float x = -5;
    for (const MaterialModel& model : models) {
      const Id<TriangleMesh> tile =
          add_quads(scene, {{{{x, -2, 0}, {x + 1, -2, 0.1f}, {x + 1, 2, 0.3f}, {x, 2, 0}}}});
      scene.meshes[tile.value].uvs = {{0, 0}, {0.3f, 1}, {1, 1}, {1, 0}};
      add_shape(scene, tile, Material{model});
      x += 1;
    }
    const Id<TriangleMesh> lamp = add_quads(scene, {{{{-3, -1, 4}, {-3, 1, 4}, {3, 1, 4}, {3, -1, 4}}}});
    scene.meshes[lamp.value].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_shape(scene, lamp, grey(0.2f), AreaLight{ConstantSpectrum{9}});
    scene.lights.push_back({InfiniteLight{ConstantSpectrum{0.3f}}, {}});
    look_along(scene, {0, -0.3, 1}, {}, 5);
    scene.film.layers = layers;
    const Film film = render(scene, 16).film;
    std::vector<XYZ> pixels;
    for (std::uint32_t i = 0; i < film.pixels(); ++i) pixels.push_back(film.mean(i));
    return pixels;
  };
  const std::vector<XYZ> alone = picture({});
  for (std::size_t i = 0; i < layer_count; ++i) {
    FilmLayers one;
    one.add(static_cast<Layer>(i));
    EXPECT_EQ(picture(one), alone) << kind_of(static_cast<Layer>(i)).name;
  }
}

}  // namespace
}  // namespace vitrail::test::layers_test
