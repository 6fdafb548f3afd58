// SPDX-License-Identifier: Apache-2.0
// Lights whose image is black but for one texel, anywhere: they shine, by as much as the texel has, and
// whatever can shine has a density.
#include <gtest/gtest.h>

#include <functional>

#include "scene/geometry/portable_math.h"
#include "tests/tracer/lights/textured_lights.h"
#include "tracer/lights/emission.h"
#include "tracer/lights/sphere_map.h"

namespace vitrail::lone_texels_test {

namespace {

using test::Random;
using test::TexturedLights;

struct Size {
  std::uint32_t width, height;
};
constexpr std::array<Size, 7> sizes{{{1, 1}, {64, 64}, {1, 33}, {47, 1}, {130, 70}, {100, 90}, {180, 3}}};

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random() * static_cast<double>(count));
}

// One texel of `value`, in a corner, on an edge or anywhere.
std::vector<float> lone_texel(Random& random, Size size, float value) {
  const auto along = [&](std::uint32_t n) {
    const double kind = random();
    return kind < 0.2 ? 0 : kind < 0.4 ? n - 1 : static_cast<std::uint32_t>(below(random, n));
  };
  std::vector<float> rows(std::size_t{size.width} * size.height, 0.0f);
  rows[along(size.height) * size.width + along(size.width)] = value;
  return rows;
}

std::vector<Texture> image_texture(Random& random, bool turned = true) {
  constexpr std::array wraps{Wrap::repeat, Wrap::clamp, Wrap::mirror, Wrap::black};
  ImageTexture image;
  image.filename = test::file_of_image;
  image.wrap = wraps[below(random, 4)];
  image.filter = random() < 0.5 ? TextureFilter::nearest : TextureFilter::bilinear;
  if (turned && random() < 0.5)
    image.mapping =
        UvMapping{static_cast<float>(random.between(0.3, 2)),   0, static_cast<float>(random()), 0,
                  static_cast<float>(random.between(-2, -0.3)), 1};
  return {Texture{image, false, "", {}}};
}

// Means of what `sample` gives, against `expected`.
void expect_mean(double expected, int samples, const std::function<double()>& sample,
                 const std::string& what) {
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    const double x = sample();
    sum += x / samples;
    squares += x * x / samples;
  }
  EXPECT_NEAR(sum, expected, 4.5 * std::sqrt(std::max(0.0, squares - sum * sum) / samples) + 5e-3 * expected)
      << what;
}

double emitted_flux(const Emission& emission, Random& random) {
  return static_cast<double>(
      emission.sample(random.four(), random.four(), test::some_wavelengths()).power[0]);
}

// ∫ f over the unit square, of what is 0 but in a part of it.
double integral(const std::function<double(double, double)>& f) {
  constexpr int n = 400;
  Bounds3d lit;
  for (int i = 0; i < n * n; ++i)
    if (const Point3d at{(i % n + 0.5) / n, (i / n + 0.5) / n, 0}; f(at.x, at.y) != 0) extend(lit, at);
  if (lit.empty()) return 0;
  const auto lower = [&](int axis) { return std::max(0.0, lit.lower[axis] - 1.0 / n); };
  const auto width = [&](int axis) { return std::min(1.0, lit.upper[axis] + 1.0 / n) - lower(axis); };
  double sum = 0;
  for (int i = 0; i < n * n; ++i)
    sum += f(lower(0) + width(0) * (i % n + 0.5) / n, lower(1) + width(1) * (i / n + 0.5) / n);
  return sum * width(0) * width(1) / (n * n);
}

// ∫ I dω over the square at z = 1 that a projection of 90° lights.
double projected(const LightSampler& s) {
  return integral([&](double x, double y) {
    const Vector3d d{2 * x - 1, 2 * y - 1, 1};
    const double cosine = 1 / length(d);
    return 4 * cosine * cosine * cosine *
           static_cast<double>(
               intensity(s.emitters[0], normalize(d), s.scene.textures, test::some_wavelengths())[0]);
  });
}

}  // namespace

TEST(LoneTexels, OfProjections) {
  Random random(1);
  for (int i = 0; i < 24; ++i) {
    const Size size = sizes[static_cast<std::size_t>(i) % sizes.size()];
    const std::string what =
        std::to_string(i) + ": " + std::to_string(size.width) + " × " + std::to_string(size.height);
    std::vector<Texture> records = image_texture(random, i % 2 == 0);
    // Of a square of the plane, whatever the shape of the image.
    records.push_back({ProductTexture{Id<Texture>{0}, ConstantSpectrum{1}}, false, "", {}});
    const TexturedLights bundle(records, size.width, size.height, lone_texel(random, size, 100));
    ProjectionLight light;
    light.fov_deg = 90;
    light.irradiance = i % 3 == 0;
    light.image = Id<Texture>{1};
    const std::vector<Light> guessed{{light, {}}};
    const LightSampler about = make_light_sampler(bundle.scene(guessed), bundle.directory.path());
    const double flux = projected(about);
    if (flux > 0) {
      EXPECT_NEAR(about.emitters[0].flux, flux, 0.5 * flux) << what;
      const Emission emission(about, about.scene.bounds, {});
      expect_mean(
          flux, 20000, [&] { return emitted_flux(emission, random); }, what);
    } else {
      EXPECT_LT(about.emitters[0].flux, 0.05) << what;  // within the reach of a box
    }
    if (size.width != size.height) continue;
    light.image = Id<Texture>{0};
    light.power = 10.0f;
    const std::vector<Light> given{{light, {}}};
    const LightSampler exact = make_light_sampler(bundle.scene(given), bundle.directory.path());
    if (flux > 0) {
      EXPECT_NEAR(projected(exact), 10, 0.01 * 10) << what;
    }
  }
}

TEST(LoneTexels, OfGoniometricLights) {
  Random random(2);
  for (int i = 0; i < 14; ++i) {
    GoniometricLight light;
    light.intensity = ConstantSpectrum{2};
    light.latitude_longitude = i % 2 == 1;
    light.power = 20.0f;
    light.light_to_world = rotate(1, {1, 2, 3});
    const Size size =
        light.latitude_longitude ? sizes[static_cast<std::size_t>(i) % sizes.size()] : Size{64, 64};
    const std::vector<float> rows = lone_texel(random, size, 100);
    std::vector<double> up;  // from the bottom
    for (std::uint32_t y = size.height; y-- > 0;)
      up.insert(up.end(), rows.begin() + y * size.width, rows.begin() + (y + 1) * size.width);
    const auto image =
        std::make_shared<test::GreyImage>(static_cast<int>(size.width), static_cast<int>(size.height), up);
    const std::vector<Light> lights{{light, {}}};
    LightScene scene;
    scene.lights = lights;
    scene.bounds = {{-1, -1, -1}, {1, 1, 1}};
    const LightSampler s = make_light_sampler(scene, test::only(image));
    const Emission emission(s, scene.bounds, {});
    expect_mean(
        40, 20000, [&] { return emitted_flux(emission, random); }, std::to_string(i));
  }
}

TEST(LoneTexels, OfEnvironmentsWithAnIlluminance) {
  Random random(3);
  for (int i = 0; i < 14; ++i) {
    const bool turned = i % 2 == 1;
    const Size size = turned ? sizes[static_cast<std::size_t>(i) % sizes.size()] : Size{100, 100};
    const TexturedLights bundle(image_texture(random), size.width, size.height,
                                lone_texel(random, size, 100));
    EnvironmentLight light;
    light.filename = test::file_of_image;
    light.projection =
        turned ? EnvironmentLight::Projection::latitude_longitude : EnvironmentLight::Projection::equal_area;
    light.illuminance = 5.0f;
    const std::vector<Light> lights{{light, {}}};
    const LightSampler s = make_light_sampler(bundle.scene(lights), bundle.directory.path());
    ASSERT_EQ(s.environments.size(), 1u);
    const double up = integral([&](double x, double y) {
      const Vector3d d = sphere_direction(light.projection, {x, y});
      if (d.z <= 0) return 0.0;
      return static_cast<double>(background(s, d, test::some_wavelengths()).radiance[0]) * d.z *
             (turned ? 2 * pi * pi * portable_sin(pi * y) : 4 * pi);
    });
    if (up > 0) {
      EXPECT_NEAR(up, 5, 0.02 * 5) << i;
    }
    expect_mean(
        up, 20000,
        [&] {
          const auto l = sample_light(s, {}, random.four(), test::some_wavelengths());
          return l ? static_cast<double>(l->radiance[0]) * std::max(0.0, l->to_light.z) / l->pdf : 0;
        },
        std::to_string(i));
  }
}

namespace {

// What a lamp of two triangles, or a quadric, sends to a point, by a lattice over its (u,v).
struct Lamp {
  AreaLight light;
  std::vector<EmissiveTriangle> triangles;
  std::vector<FloatParameter> opacities;

  explicit Lamp(const FloatParameter& opacity, float uv_scale) {
    light.radiance = Id<Texture>{0};
    light.scale = 2;
    const Point3f a{-1, -1, 0}, b{1, -1, 0}, c{1, 1, 0}, d{-1, 1, 0};
    const float k = uv_scale;
    triangles = {{{a, b, c}, {{0, 0}, {k, 0}, {k, k}}, 7, 0}, {{a, c, d}, {{0, 0}, {k, k}, {0, k}}, 8, 0}};
    opacities = {opacity, opacity};
  }
  LightScene scene(const TexturedLights& bundle) const {
    LightScene s = bundle.scene({});
    s.area_lights = {&light, 1};
    s.triangles = triangles;
    s.opacities = opacities;
    return s;
  }
};

}  // namespace

TEST(LoneTexels, OfLampsOfTriangles) {
  Random random(4);
  for (int i = 0; i < 21; ++i) {
    const Size size = sizes[static_cast<std::size_t>(i) % sizes.size()];
    std::vector<Texture> records = image_texture(random);
    if (i % 2 == 1)  // small and repeated: smooth, for the lattice that it is held to
      std::get<ImageTexture>(records[0].model).filter = TextureFilter::bilinear;
    Texture mask{CheckerboardTexture{ConstantSpectrum{1}, ConstantSpectrum{0}, UvMapping{5, 0, 0, 0, 5, 0}},
                 true,
                 "",
                 {}};
    records.push_back(mask);
    const TexturedLights bundle(records, size.width, size.height, lone_texel(random, size, 100));
    const FloatParameter opacity = i % 3 == 0   ? FloatParameter{1.0f}
                                   : i % 3 == 1 ? FloatParameter{0.0f}
                                                : FloatParameter{Id<Texture>{1}};
    const Lamp lamp(opacity, i % 2 == 0 ? 1 : 1.7f);
    const LightSampler s = make_light_sampler(lamp.scene(bundle), bundle.directory.path());
    const Point3d p{0.3, 0.2, 1.5};
    const auto radiance = [&](double u, double v) {
      const std::uint32_t triangle = u > v ? 0 : 1;
      const EmissivePoint point(s.scene, triangle, triangle == 0 ? u - v : u, triangle == 0 ? v : v - u);
      const LightRef light{LightKind::triangle, triangle};
      return static_cast<double>(leaving(s, light, point, test::some_wavelengths())[0]);
    };
    const double flux = 4 * pi * integral(radiance),
                 seen = integral([&](double u, double v) {
                   const Vector3d to = Point3d{2 * u - 1, 2 * v - 1, 0} - p;
                   return 4 * radiance(u, v) * to.z * to.z / (dot(to, to) * dot(to, to));
                 });
    const std::string what = std::to_string(i);
    for (int k = 0; k < 4000; ++k) {
      const double u = random(), v = random();
      if (radiance(u, v) > 0) {
        ASSERT_GT(triangle_pdf(s, p, u > v ? 7 : 8, {2 * u - 1, 2 * v - 1, 0}, 1, 1), 0) << what;
      }
    }
    expect_mean(
        seen, 60000,
        [&] {
          const auto l = sample_light(s, p, random.four(), test::some_wavelengths());
          if (!l) return 0.0;
          const Point3d at = p + l->to_light * l->distance;
          EXPECT_NEAR(triangle_pdf(s, p, at.x > at.y ? 7 : 8, at, l->distance, -l->to_light.z), l->pdf,
                      1e-6 * l->pdf);
          return static_cast<double>(l->radiance[0]) * -l->to_light.z / l->pdf;
        },
        what);
    const Emission emission(s, s.scene.bounds, {});
    if (flux > 0)
      expect_mean(
          flux, 60000, [&] { return emitted_flux(emission, random); }, what);
  }
}

TEST(LoneTexels, OfLampsOfQuadrics) {
  Random random(5);
  for (int i = 0; i < 18; ++i) {
    const Size size = sizes[static_cast<std::size_t>(i) % sizes.size()];
    const TexturedLights bundle(image_texture(random), size.width, size.height,
                                lone_texel(random, size, 100));
    AreaLight light;
    light.radiance = Id<Texture>{0};
    EmissiveQuadric e;
    e.quadric.quadric.kind = std::array{QuadricKind::sphere, QuadricKind::disk, QuadricKind::cylinder}[i % 3];
    if (i % 3 == 2) e.quadric.quadric.low = 0, e.quadric.quadric.high = 1;
    e.opacity = i % 2 == 0 ? 1.0f : 0.0f;
    const std::vector<EmissiveQuadric> quadrics{e};
    LightScene scene = bundle.scene({});
    scene.area_lights = {&light, 1};
    scene.quadrics = quadrics;
    const LightSampler s = make_light_sampler(scene, bundle.directory.path());
    const double flux = pi * s.quadrics[0].area() * integral([&](double x, double y) {
                          const EmissivePoint point(s.quadrics[0], point_by_area(e.quadric.quadric, x, y));
                          const LightRef lamp{LightKind::quadric, 0};
                          return static_cast<double>(leaving(s, lamp, point, test::some_wavelengths())[0]);
                        });
    const Emission emission(s, scene.bounds, {});
    if (flux > 0)
      expect_mean(
          flux, 20000, [&] { return emitted_flux(emission, random); }, std::to_string(i));
  }
}

// A sheet of small triangles whose texture is made of others: wherever some point shines, its triangle is
// chosen.
TEST(LoneTexels, OfTexturesThatAreComputed) {
  Random random(6);
  const auto noise = [](NoiseTexture::Kind kind) {
    NoiseTexture n;
    n.kind = kind;
    n.texture_to_world = scale({0.3, 0.2, 0.4});
    return Texture{n, true, "", {}};
  };
  std::vector<Texture> records = image_texture(random, false);
  records.push_back(noise(NoiseTexture::Kind::fbm));
  records.push_back(noise(NoiseTexture::Kind::windy));
  records.push_back(
      {DotsTexture{ConstantSpectrum{1}, ConstantSpectrum{0}, UvMapping{9, 0, 0, 0, 9, 0}}, false, "", {}});
  records.push_back({MixTexture{ConstantSpectrum{0}, Id<Texture>{0}, Id<Texture>{1}}, false, "", {}});
  records.push_back({ProductTexture{Id<Texture>{1}, Id<Texture>{2}}, false, "", {}});
  records.push_back({MixTexture{ConstantSpectrum{1}, ConstantSpectrum{0.2f}, Id<Texture>{2}}, false, "", {}});
  records.push_back(
      {BilinearTexture{ConstantSpectrum{0}, Id<Texture>{3}, ConstantSpectrum{0}, Id<Texture>{5}, {}},
       false,
       "",
       {}});
  records.push_back(
      {CheckerboardTexture{ConstantSpectrum{0}, Id<Texture>{7}, {}, true, scale({0.11, 0.07, 1})},
       false,
       "",
       {}});
  std::vector<float> rows(32 * 32, 0.0f);
  for (std::size_t i = 0; i < rows.size(); i += 37) rows[i] = 3;
  const TexturedLights bundle(records, 32, 32, rows);
  for (std::uint32_t id = 1; id < records.size(); ++id) {
    AreaLight light;
    light.radiance = Id<Texture>{id};
    std::vector<EmissiveTriangle> triangles;
    constexpr int cells = 12;
    for (std::uint32_t i = 0; i < cells * cells; ++i) {
      const auto corner = [&](std::uint32_t dx, std::uint32_t dy) {
        return Point2f{static_cast<float>(i % cells + dx) / cells,
                       static_cast<float>(i / cells + dy) / cells};
      };
      const Point2f a = corner(0, 0), b = corner(1, 0), c = corner(1, 1);
      triangles.push_back({{{a.x, a.y, 0.1f}, {b.x, b.y, 0.2f}, {c.x, c.y, 0.1f}}, {a, b, c}, i, 0});
    }
    LightScene scene = bundle.scene({});
    scene.area_lights = {&light, 1};
    scene.triangles = triangles;
    const LightSampler s = make_light_sampler(scene, bundle.directory.path());
    int shining = 0;
    for (int i = 0; i < 40000; ++i) {
      const auto triangle = static_cast<std::uint32_t>(below(random, triangles.size()));
      const double u = random(), v = random();
      const EmissivePoint point(scene, triangle, u * (1 - v), v);
      const LightRef lamp{LightKind::triangle, triangle};
      if (!(leaving(s, lamp, point, test::some_wavelengths())[0] > 0)) continue;
      ++shining;
      ASSERT_GT(triangle_pdf(s, {0.5, 0.5, 3}, triangle, point.at.p, 3, 0.9), 0) << id;
    }
    EXPECT_GT(shining, 20) << id;
  }
}

}  // namespace vitrail::lone_texels_test
