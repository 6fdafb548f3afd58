// SPDX-License-Identifier: Apache-2.0
// Light in media against closed forms, in configurations where randomness repeats: parallel view and light,
// flat layers, coefficients that differ between wavelengths by orders of magnitude, many collisions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/laws/light/flat_scenes.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/media/free_flight.h"
#include "tracer/rays/ray_records.h"

namespace vitrail::test::means_of_media_test {
namespace {

using Values = std::array<double, hero_count>;
constexpr SampledWavelengths wavelengths{{450, 520, 580, 650}, {1, 1, 1, 1}};

// Linear in between.
Spectrum at_wavelengths(const Values& v) {
  std::vector<std::array<double, 2>> samples;
  for (std::size_t i = 0; i < hero_count; ++i)
    samples.push_back({static_cast<double>(wavelengths.lambda_nm[i]), v[i]});
  return tabulate(samples, true);
}

struct Coefficients {
  Values sigma_t, albedo;
};

Medium medium_of(const Coefficients& c, bool grid) {
  Medium m;
  m.coefficients = ExtinctionAlbedo{at_wavelengths(c.sigma_t), at_wavelengths(c.albedo)};
  if (grid) {
    Grid one;
    one.nx = one.ny = one.nz = 1, one.values = {1};
    one.bounds = {{-1e5, -1e5, -1e5}, {1e5, 1e5, 1e5}};
    m.density = one;
  }
  return m;
}

// ---- A rod: light goes forwards or back, either as likely

// Of a rod of length 1 (Kubelka and Munk 1931; Schuster 1905).
struct Rod {
  double reflected, transmitted;
};
Rod rod(double sigma_t, double albedo) {
  const double s = sigma_t * albedo / 2, k = sigma_t * (1 - albedo);
  if (k == 0) return {s / (1 + s), 1 / (1 + s)};
  const double a = (s + k) / s, b = std::sqrt(a * a - 1);
  const double below = a * std::sinh(b * s) + b * std::cosh(b * s);
  return {std::sinh(b * s) / below, b / below};
}

struct Estimate {
  Values mean{}, variance{};  // of one walk
};

// `walk(random, end)` adds to what is transmitted (end 0) or reflected (end 1), once.
template <class Walk>
std::array<Estimate, 2> estimate(int walks, const Walk& walk) {
  std::array<Estimate, 2> e;
  for (int i = 0; i < walks; ++i) {
    RandomStream random(stream_seed({}, static_cast<std::uint64_t>(i), 0));
    const auto [end, weight] = walk(random);
    for (std::size_t k = 0; k < hero_count; ++k) {
      const auto w = static_cast<double>(weight.v[k]);
      e[end].mean[k] += w / walks, e[end].variance[k] += w * w / walks;
    }
  }
  for (Estimate& x : e)
    for (std::size_t k = 0; k < hero_count; ++k) x.variance[k] -= x.mean[k] * x.mean[k];
  return e;
}

struct WalkEnd {
  std::size_t end;
  SampledSpectrum weight;
};

// By the tracer's flights.
WalkEnd walk_by_flights(const PreparedMedium& medium, RandomStream& random) {
  SampledSpectrum throughput = filled(1);
  double z = 0, d = 1;
  while (!is_black(throughput)) {
    const Flight flight{{0, 0, z}, {0, 0, d}, d > 0 ? 1 - z : z};
    const FlightSample s = sample_flight(medium, flight, wavelengths, hero_count, throughput, random);
    throughput = throughput * s.weight;
    if (!s.scattered_at) break;
    z += d * *s.scattered_at;
    d = random.next() < 0.5 ? 1 : -1;
  }
  return {d > 0 ? 0u : 1u, throughput};
}

// The reference: one wavelength, chosen once, samples the whole walk, and the walk is weighed by the mean of
// the densities that all wavelengths give it.
WalkEnd walk_of_one_wavelength(const Coefficients& c, RandomStream& random) {
  const auto hero = static_cast<std::size_t>(random.next() * hero_count);
  Values value, density;
  value.fill(1), density.fill(1);
  double z = 0, d = 1;
  for (;;) {
    const double limit = d > 0 ? 1 - z : z, t = -std::log(1 - random.next()) / c.sigma_t[hero];
    const bool arrives = t >= limit;
    for (std::size_t i = 0; i < hero_count; ++i) {
      const double through = std::exp(-c.sigma_t[i] * std::min(t, limit));
      density[i] *= arrives ? through : through * c.sigma_t[i];
      value[i] *= arrives ? through : through * c.sigma_t[i] * c.albedo[i];
    }
    if (arrives) break;
    z += d * t;
    d = random.next() < 0.5 ? 1 : -1;
    const double scale = 1 / *std::max_element(density.begin(), density.end());
    for (std::size_t i = 0; i < hero_count; ++i) density[i] *= scale, value[i] *= scale;
  }
  WalkEnd e{d > 0 ? 0u : 1u, {}};
  const double sum = density[0] + density[1] + density[2] + density[3];
  for (std::size_t i = 0; i < hero_count; ++i)
    e.weight.v[i] = static_cast<float>(value[i] * hero_count / sum);
  return e;
}

// The mean is the closed form's, and the variance at most a little above the reference's at every wavelength;
// in a grid, where wavelengths weigh each null collision too, somewhat more.
void expect_rod(const Coefficients& c, bool grid, double variance_ratio) {
  constexpr int walks = 100000;
  const Medium medium = medium_of(c, grid);
  const PreparedMedium prepared = prepare(medium);
  ASSERT_EQ(prepared.homogeneous, !grid);
  const auto found = estimate(walks, [&](RandomStream& r) { return walk_by_flights(prepared, r); });
  const auto reference = estimate(walks, [&](RandomStream& r) { return walk_of_one_wavelength(c, r); });
  for (std::size_t end = 0; end < 2; ++end)
    for (std::size_t i = 0; i < hero_count; ++i) {
      const Rod exact = rod(c.sigma_t[i], c.albedo[i]);
      const double expected = end == 0 ? exact.transmitted : exact.reflected;
      const double error = std::sqrt(std::max(found[end].variance[i], reference[end].variance[i]) / walks);
      const auto what = fmt::format("{}, σt {}, albedo {}, {}", grid ? "grid" : "homogeneous", c.sigma_t[i],
                                    c.albedo[i], end == 0 ? "through" : "back");
      EXPECT_NEAR(found[end].mean[i], expected, 4.5 * error + 1e-5) << what;
      EXPECT_NEAR(reference[end].mean[i], expected,
                  4.5 * std::sqrt(reference[end].variance[i] / walks) + 1e-5)
          << what;
      const double ratio = found[end].variance[i] / reference[end].variance[i];
      EXPECT_LT(ratio, variance_ratio) << what;
      fmt::print("{}: variance {:.3f} of the reference's\n", what, ratio);
    }
}

TEST(ChromaticRod, HomogeneousIsAsGoodAsWeighingWholePaths) {
  expect_rod({{20, 5, 2, 0.5}, {1, 1, 1, 1}}, false, 1.1);
  expect_rod({{20, 5, 2, 0.5}, {0.99, 0.9, 0.99, 0.9}}, false, 1.1);
  expect_rod({{100, 10, 1, 0.1}, {0.999, 0.999, 0.999, 0.999}}, false, 1.1);
}

TEST(ChromaticRod, Grid) {
  expect_rod({{20, 5, 2, 0.5}, {1, 1, 1, 1}}, true, 1.5);
  expect_rod({{20, 5, 2, 0.5}, {0.99, 0.9, 0.99, 0.9}}, true, 1.5);
}

// ---- A half space that scatters to all sides alike

// Chandrasekhar's H for isotropic scattering ("Radiative Transfer", 1950, §§ 38–41), by iteration of
// 1/H(μ) = √(1 − ω) + (ω/2)·∫ μ'/(μ + μ')·H(μ') dμ'.
class HFunction {
 public:
  explicit HFunction(double albedo) : albedo_(albedo), values_(count, 1.0) {
    for (int step = 0; step < 80; ++step) {
      std::vector<double> next(count);
      for (std::size_t i = 0; i < count; ++i) next[i] = at(node(i));
      values_ = next;
    }
  }
  double at(double mu) const {
    double integral = 0;
    for (std::size_t i = 0; i < count; ++i) integral += node(i) / (mu + node(i)) * values_[i] / count;
    return 1 / (std::sqrt(1 - albedo_) + albedo_ / 2 * integral);
  }

 private:
  static constexpr std::size_t count = 100;
  static double node(std::size_t i) { return (static_cast<double>(i) + 0.5) / count; }
  double albedo_;
  std::vector<double> values_;
};

// What it sends along `out` of parallel light of irradiance 1 across it.
double diffusely_reflected(double albedo, double out, double in) {
  const HFunction h(albedo);
  return albedo / (4 * pi) * in / (out + in) * h.at(out) * h.at(in);
}

Mean half_space(const Medium& medium, Vector3d out, Vector3d in, int samples) {
  Scene scene;
  const float wide = 20000;
  add_shape(scene, add_quads(scene, box_faces({-wide, -wide, -2000}, {wide, wide, 0})),
            Material{InterfaceMaterial{}});
  scene.media.push_back(medium);
  scene.shapes.back().interior = Id<Medium>{0};
  scene.lights.push_back(Light{DistantLight{-in, ConstantSpectrum{1}}});
  look_along(scene, out);
  scene.settings.max_depth = 250;
  scene.settings.straight_counts = false;
  return mean_of(render(scene, samples).film);
}

TEST(HalfSpace, OfEqualWavelengths) {
  const Vector3d out = direction(50, 10), in = direction(20, 200);
  const Coefficients c{{1, 1, 1, 1}, {0.9, 0.9, 0.9, 0.9}};
  for (const bool grid : {false, true})
    expect_luminance(half_space(medium_of(c, grid), out, in, 64), diffusely_reflected(0.9, out.z, in.z), 0.01,
                     grid ? "grid" : "homogeneous", 1e-3);
}

// Its depth is so great that only the albedo counts.
TEST(HalfSpace, OfExtinctionsFarApart) {
  const Vector3d out = direction(50, 10), in = direction(20, 200);
  const Coefficients c{{0.05, 0.3, 2, 20}, {0.95, 0.9, 0.8, 0.97}};
  std::vector<std::array<double, 2>> values;
  const Spectrum albedo = at_wavelengths(c.albedo);
  for (double lambda = 360; lambda <= 830; lambda += 10)
    values.push_back({lambda, diffusely_reflected(evaluate(albedo, lambda), out.z, in.z)});
  const XYZ want = to_xyz(Spectrum{tabulate(values, true)});
  const Mean found = half_space(medium_of(c, false), out, in, 32);
  expect_luminance(found, want.y, 0.011, "Y", 2e-3);
  EXPECT_NEAR(found.value.x, want.x, 4.5 * found.error.x + 2e-3 * want.x);
  EXPECT_NEAR(found.value.z, want.z, 4.5 * found.error.z + 2e-3 * want.z);
  EXPECT_LT(found.error.x, 0.02 * want.x);
  EXPECT_LT(found.error.z, 0.02 * want.z);
}

// ---- Under a surface

// Of the sky that falls on a sphere, the surface sends back 2∫F(μ)μ dμ and the interior `reflectance` of the
// rest, whatever the depth that paths may have.
TEST(Subsurface, SphereSendsBackItsReflectance) {
  constexpr float eta = 1.33f;
  const double surface = fresnel_diffuse(static_cast<double>(eta));
  for (const double reflectance : {0.25, 0.8}) {
    Scene scene;
    SubsurfaceMaterial m;
    m.eta = ConstantSpectrum{eta};
    m.interior = SubsurfaceMaterial::Effective{ConstantSpectrum{static_cast<float>(reflectance)},
                                               ConstantSpectrum{1e-3f}};
    TriangleMesh mesh;
    mesh.quadric = Quadric{QuadricKind::sphere};
    scene.meshes.push_back(mesh);
    add_shape(scene, Id<TriangleMesh>{0}, Material{m});
    scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
    look_along(scene, direction(0), {}, 1);
    scene.settings.max_depth = 4;
    const double disc = pi / 4, sent = surface + (1 - surface) * reflectance;
    const Brightness found = brightness(render(scene, 64).film);
    EXPECT_NEAR(found.mean, 1 - disc + disc * sent, 4.5 * found.standard_error + 1e-3) << reflectance;
    EXPECT_LT(found.standard_error, 0.005);
  }
}

// ---- Absorption and glow

Mean through_slab(Medium medium, bool lamp, bool grid) {
  Scene scene;
  add_shape(scene, square(scene, -3), Material{DiffuseMaterial{ConstantSpectrum{0}}},
            lamp ? std::optional(AreaLight{ConstantSpectrum{1}}) : std::nullopt);
  add_shape(scene, add_quads(scene, box_faces({-1000, -1000, -2}, {1000, 1000, 0})),
            Material{InterfaceMaterial{}});
  if (grid) {
    Grid ramp;  // linear from 0.5 to 1.5 along z within the slab
    ramp.nx = ramp.ny = 1, ramp.nz = 2, ramp.values = {0.5f, 1.5f};
    ramp.bounds = {{-2000, -2000, -3}, {2000, 2000, 1}};
    medium.density = ramp;
  }
  scene.media.push_back(medium);
  scene.shapes.back().interior = Id<Medium>{0};
  look_along(scene, direction(60, 30));
  scene.settings.max_depth = 3;
  return mean_of(render(scene, 256).film);
}

TEST(Slab, AbsorbsAndGlows) {
  Medium medium;
  medium.coefficients = AbsorptionScattering{ConstantSpectrum{0.4f}, ConstantSpectrum{0}};
  const double passed = std::exp(-static_cast<double>(0.4f) * 2 / direction(60).z);
  for (const bool grid : {false, true}) {
    expect_luminance(through_slab(medium, true, grid), passed, 0.01, grid ? "grid absorbs" : "absorbs", 1e-3);
    Medium glowing = medium;
    glowing.emission = ConstantSpectrum{2};
    expect_luminance(through_slab(glowing, false, grid), 2 * (1 - passed), 0.01,
                     grid ? "grid glows" : "glows", 1e-3);
  }
}

// ---- Glow that scatters: everywhere the same, so the orders of scattering are a geometric series

Mean glow_of_infinite_medium(float sigma_a, int depth, int pixels, int samples) {
  Scene scene;
  add_shape(scene, square(scene, 0, 1e-3f), Material{InterfaceMaterial{}});
  Medium medium;
  medium.coefficients = AbsorptionScattering{ConstantSpectrum{sigma_a}, ConstantSpectrum{1}};
  medium.emission = ConstantSpectrum{1};
  scene.media.push_back(medium);
  scene.camera_medium = Id<Medium>{0};
  scene.shapes.back().exterior = scene.shapes.back().interior = Id<Medium>{0};
  look_along(scene, direction(0), {5, 5, 0});
  scene.film.width = scene.film.height = pixels;
  scene.film.crop = {0, pixels, 0, pixels};
  scene.settings.max_depth = depth;
  scene.settings.straight_counts = false;
  return mean_of(render(scene, samples).film);
}

// A white square under a sky and a sun, in a medium that only absorbs: what comes from infinitely far comes
// through as much of it as the scene is wide, or as twice the distance from its centre.
TEST(InfiniteMedium, WeakensLightFromFarOverTheWidthOfTheScene) {
  for (const bool sun : {false, true}) {
    constexpr double sigma = 0.3, width = 2 * std::numbers::sqrt2, distance = 4;
    Scene scene;
    add_shape(scene, add_quads(scene, {{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}}),
              Material{DiffuseMaterial{Spectrum{ConstantSpectrum{1}}}});
    Medium medium;
    medium.coefficients =
        AbsorptionScattering{ConstantSpectrum{static_cast<float>(sigma)}, ConstantSpectrum{0}};
    scene.media.push_back(medium);
    scene.camera_medium = Id<Medium>{0};
    scene.shapes.back().exterior = scene.shapes.back().interior = Id<Medium>{0};
    if (sun)
      scene.lights.push_back({DistantLight{{0, 0, -1}, emission_from_rgb({pi, pi, pi})}});
    else
      scene.lights.push_back({InfiniteLight{emission_from_rgb({1, 1, 1})}});
    set_camera(scene, {0, 0, distance}, {0, 0, 0}, {0, 1, 0}, 0.01, 4, 4);
    expect_luminance(mean_of(render(scene, 64).film), std::exp(-sigma * (distance + width)), 0.01,
                     sun ? "sun" : "sky", 1e-3);
    if (sun) continue;
    set_camera(scene, {0, 0, distance}, {0, 0, 2 * distance}, {0, 1, 0}, 0.01, 4, 4);
    expect_luminance(mean_of(render(scene, 64).film), std::exp(-sigma * 2 * distance), 0.01, "sky alone",
                     1e-5);
  }
}

// 1 − ωⁿ⁺¹ after n scatterings.
TEST(InfiniteMedium, GlowsAsAGeometricSeries) {
  const auto expected = [](float sigma_a, int depth) {
    const double albedo = 1 / (1 + static_cast<double>(sigma_a));
    return 1 - std::pow(albedo, depth + 1);
  };
  for (const auto& [sigma_a, depth, samples] :
       {std::tuple{0.5f, 3, 256}, std::tuple{1e-3f, 250, 16}, std::tuple{1e-6f, 250, 16}})
    expect_luminance(glow_of_infinite_medium(sigma_a, depth, 8, samples), expected(sigma_a, depth), 0.02,
                     fmt::format("σa {}, depth {}", sigma_a, depth), 2e-3);
}

// What is lost at each scattering is less than half a step of the throughput as it travels: rounding it to
// the nearest, all would live on, and glow by 0.3 instead of 0.26.
TEST(InfiniteMedium, AtAlbedosNearOneAndGreatDepth) {
  constexpr int depth = max_path_depth;
  for (const auto& [sigma_a, pixels] : {std::pair{3e-6f, 8}, std::pair{1e-7f, 4}}) {
    const double albedo = 1 / (1 + static_cast<double>(sigma_a));
    expect_luminance(glow_of_infinite_medium(sigma_a, depth, pixels, 2), 1 - std::pow(albedo, depth + 1),
                     0.04, fmt::format("σa {}", sigma_a), 5e-3);
  }
}

}  // namespace
}  // namespace vitrail::test::means_of_media_test
