// SPDX-License-Identifier: Apache-2.0
// Every model of scattering as a picture shows it: the mean radiance of a plane in parallel light, and under
// a uniform sky, seen in parallel. Light and view are the same in every sample, so what a model draws at
// random has to be drawn anew for each.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/geometry/portable_math.h"
#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/laws/light/flat_scenes.h"
#include "tests/support/long_tests.h"
#include "tracer/bsdf/conductor.h"
#include "tracer/bsdf/dielectric.h"
#include "tracer/bsdf/diffuse.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/layered.h"
#include "tracer/bsdf/local.h"
#include "tracer/bsdf/plastic.h"
#include "tracer/bsdf/principled.h"

namespace vitrail::test::means_of_surfaces_test {
namespace {

const Vector3d view = direction(40, 25), steep = direction(5, 100), grazing = direction(89, 200);

Microfacets facets(double alpha, Masking masking) {
  return make_microfacets(alpha, alpha, Roughness::Distribution::ggx, masking);
}

Roughness rough(float alpha, Masking masking = Masking::separable) {
  Roughness r;
  r.alpha_u = r.alpha_v = alpha;
  r.masking = masking;
  return r;
}

template <class Model>
double value(const Model& model, Vector3d out, Vector3d in) {
  return static_cast<double>(eval(model, out, in).value[0]);
}

// What a plane shows of parallel light and of the sky, against the model itself. `mirrored`: what it reflects
// besides, as a mirror does.
template <class Model>
void expect_plane(const Material& material, const Model& model, const std::string& name, double mirrored = 0,
                  double slack = 2e-3) {
  for (const auto& [out, in] : {std::pair{view, steep}, std::pair{steep, grazing}, std::pair{grazing, view}})
    expect_luminance(lit_plane(material, out, in, 256), value(model, out, in), 5e-3,
                     name + ", lit at " + std::to_string(in.z), slack);
  const double albedo = over_sphere([&](Vector3d in) { return value(model, view, in); });
  expect_luminance(plane_under_sky(material, view, 1024), albedo + mirrored, 5e-3, name + " under the sky",
                   slack);
}

// Under the light that it is made for, a colour by Matrix-R is that colour.
TEST(MeanOfPlane, AColorByMatrixRComesBack) {
  const RGB color{0.8, 0.25, 0.1};
  Scene scene;
  scene.settings.rgb = RgbMethod::matrix_r;
  scene.lights.push_back({InfiniteLight{emission_from_rgb({1, 1, 1})}, {}});
  add_shape(scene, square(scene, 0), Material{DiffuseMaterial{reflectance_from_rgb(color)}});
  look_along(scene, view);
  const Mean found = mean_of(render(scene, of_all(1024, 512)).film);
  const XYZ expected = srgb_to_xyz(color);
  for (const auto part : {&XYZ::x, &XYZ::y, &XYZ::z}) {
    EXPECT_LT(found.error.*part, 3e-3 * expected.*part);
    EXPECT_NEAR(found.value.*part, expected.*part, 4.5 * found.error.*part + 1e-4);
  }
}

TEST(MeanOfPlane, Diffuse) {
  expect_plane(Material{DiffuseMaterial{ConstantSpectrum{0.6f}}}, LambertBsdf{filled(0.6f)}, "Lambert");
  expect_plane(Material{DiffuseMaterial{ConstantSpectrum{0.6f}, 25.0f}},
               OrenNayarBsdf{filled(0.6f), 25 * pi / 180}, "Oren and Nayar");
  const Material sheet{DiffuseTransmissionMaterial{ConstantSpectrum{0.3f}, ConstantSpectrum{0.5f}}};
  const DiffuseTransmissionBsdf model{filled(0.3f), filled(0.5f)};
  expect_plane(sheet, model, "diffuse transmission");
  expect_luminance(lit_plane(sheet, view, -steep, 256), value(model, view, -steep), 5e-3, "from behind");
}

TEST(MeanOfPlane, Conductor) {
  const ComplexIndex index{ConstantSpectrum{0.2f}, ConstantSpectrum{3.5f}};
  for (const Masking masking : {Masking::separable, Masking::correlated}) {
    const ConductorBsdf metal{facets(0.4, masking), filled(0.2f), filled(3.5f)};
    expect_plane(Material{ConductorMaterial{index, rough(0.4f, masking)}}, metal, "rough metal");
  }
  const double mirror = static_cast<double>(fresnel_conductor(view.z, filled(0.2f), filled(3.5f), 1)[0]);
  expect_luminance(plane_under_sky(Material{ConductorMaterial{index, {}}}, view, 64), mirror, 1e-3, "mirror");
}

// pbrt-v4's own formulas: D·G/(4 cos θo cos θi) with G = 1/(1 + Λ(ωo) + Λ(ωi)), and what such a metal
// reflects of a uniform sky. At α = 1 Mitsuba's masking is 5 % darker.
TEST(MeanOfPlane, AMetalOfPbrts) {
  const double alpha = 1;
  const auto lambda = [&](Vector3d w) {
    const double tan2 = (1 - w.z * w.z) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
  };
  const auto pbrts = [&](Vector3d out, Vector3d in) {
    if (!(in.z > 0)) return 0.0;
    const Vector3d m = normalize(out + in);
    const double cos2 = m.z * m.z, e = 1 + (1 - cos2) / (cos2 * alpha * alpha);
    const double d = 1 / (pi * alpha * alpha * cos2 * cos2 * e * e);
    return d / (1 + lambda(out) + lambda(in)) / (4 * out.z);
  };
  const auto under_sky = [&](Masking masking) {
    return plane_under_sky(Material{ConductorMaterial{PerfectReflector{}, rough(1.0f, masking)}}, view, 1024);
  };
  const double expected = over_sphere([&](Vector3d in) { return pbrts(view, in); });
  expect_luminance(under_sky(Masking::correlated), expected, 5e-3, "pbrt's", 2e-3);
  EXPECT_LT(under_sky(Masking::separable).value.y, 0.975 * expected);
}

TEST(MeanOfPlane, RoughDielectric) {
  for (const Masking masking : {Masking::separable, Masking::correlated})
    for (const float eta : {1.5f, 1 / 1.5f}) {
      const DielectricBsdf model{static_cast<double>(eta), facets(0.3, masking)};
      const Material material{
          DielectricMaterial{ConstantSpectrum{eta}, ConstantSpectrum{1}, rough(0.3f, masking)}};
      expect_plane(material, model, "rough glass");
      expect_luminance(lit_plane(material, view, -steep, 256), value(model, view, -steep), 5e-3,
                       "from behind", 2e-3);
    }
}

TEST(MeanOfPlane, Plastic) {
  PlasticMaterial plastic;
  plastic.diffuse_reflectance = ConstantSpectrum{0.7f};
  const double eta = static_cast<double>(plastic.eta) / static_cast<double>(plastic.exterior_eta);
  expect_plane(Material{plastic}, PlasticBsdf{filled(0.7f), filled(1), eta, fresnel_diffuse(1 / eta)},
               "plastic", fresnel_dielectric(view.z, eta));
  for (const Masking masking : {Masking::separable, Masking::correlated}) {
    plastic.roughness = rough(0.3f, masking);
    const Microfacets coat = facets(static_cast<double>(0.3f), masking);
    const RoughPlasticTables tables = make_rough_plastic_tables(eta, coat);
    expect_plane(Material{plastic}, RoughPlasticBsdf{filled(0.7f), filled(1), eta, coat, &tables},
                 "rough plastic");
  }
}

TEST(MeanOfPlane, Principled) {
  PrincipledMaterial m;
  m.base_color = ConstantSpectrum{0.6f};
  m.roughness = 0.5f, m.metallic = 0.3f, m.spec_tint = 0.5f, m.sheen = 0.7f, m.sheen_tint = 0.5f;
  m.flatness = 0.4f, m.clearcoat = 1.0f, m.clearcoat_gloss = 0.3f, m.anisotropic = 0.0f;
  PrincipledBsdf b{.base_color = filled(0.6f), .luminance = static_cast<double>(0.6f)};
  b.metallic = 0.3, b.spec_tint = 0.5, b.sheen = 0.7, b.sheen_tint = 0.5, b.flatness = 0.4, b.clearcoat = 1,
  b.clearcoat_gloss = 0.3;
  expect_plane(Material{m}, b, "principled");
  m.spec_trans = 0.6f, b.spec_trans = 0.6;
  expect_plane(Material{m}, b, "principled glass");
  expect_luminance(lit_plane(Material{m}, view, -steep, 256), value(b, view, -steep), 5e-3, "from behind",
                   2e-3);
  m.thin = true, m.diff_trans = 0.8f;
  PrincipledThinBsdf thin{.base_color = filled(0.6f), .luminance = static_cast<double>(0.6f)};
  thin.spec_trans = 0.6, thin.spec_tint = 0.5, thin.sheen = 0.7, thin.sheen_tint = 0.5, thin.flatness = 0.4,
  thin.diff_trans = 0.8;
  expect_plane(Material{m}, thin, "principled sheet");
}

TEST(MeanOfPlane, MixturesAndMasks) {
  Scene scene;
  const auto add = [&](const MaterialModel& model) {
    scene.materials.push_back(Material{model});
    return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
  };
  const auto matt = [&](float albedo) { return add(DiffuseMaterial{ConstantSpectrum{albedo}}); };
  const Id<Material> inner = add(BlendMaterial{matt(0.8f), matt(0.2f), 0.25f});
  const Id<Material> outer = add(BlendMaterial{matt(0.5f), inner, 0.5f});
  add_shape(scene, square(scene, 0), Material{MaskMaterial{0.6f, outer}});
  scene.lights.push_back(Light{DistantLight{-steep, ConstantSpectrum{1}}});
  look_along(scene, view);
  const double albedo = 0.6 * (0.5 * 0.5 + 0.5 * (0.75 * 0.8 + 0.25 * 0.2));
  expect_luminance(mean_of(render(scene, of_all(1024, 512)).film), albedo / pi * steep.z, 5e-3,
                   "mask of mixtures");
}

// ---- Layers, whose values are walks at random

// f·cosθ of a Lambertian base of reflectance ρ under a smooth interface and a clear coating.
double smoothly_coated(double rho, double eta, double thickness, Vector3d out, Vector3d in) {
  const auto through = [&](double outside) {
    const double inside = std::sqrt(1 - (1 - outside * outside) / (eta * eta));
    return (1 - fresnel_dielectric(outside, eta)) * std::exp(-thickness / inside);
  };
  double back = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double mu = (i + .5) / steps;
    back += 2 * fresnel_dielectric(mu, 1 / eta) * std::exp(-2 * thickness / mu) * mu / steps;
  }
  return through(out.z) * through(in.z) * rho * in.z / (pi * eta * eta * (1 - rho * back));
}

TEST(MeanOfPlane, CoatedDiffuse) {
  CoatedDiffuseMaterial m;
  m.reflectance = ConstantSpectrum{0.8f};
  m.volume.max_depth = 200;
  for (const double turn : {0.0, 1e-4, 2e-4}) {
    const Vector3d in = direction(30 + turn * 180 / pi, 70);
    expect_luminance(lit_plane(Material{m}, view, in, 1024), smoothly_coated(0.8, 1.5, 0.01, view, in), 0.01,
                     "smooth coating, sun turned by " + std::to_string(turn), 2e-3);
  }
  expect_luminance(
      plane_under_sky(
          Material{CoatedDiffuseMaterial{
              ConstantSpectrum{1}, ConstantSpectrum{1.5f}, {}, {0.0f, 0.0f, ConstantSpectrum{0}, 1000}}},
          view, 1024),
      1, 0.01, "white", 5e-3);
}

// Against the mean of many walks.
template <class Model>
void expect_layers(const Material& material, Model model, const std::string& name, double precision) {
  model.volume.samples = of_all(50000, 20000);
  for (const auto& [out, in] : {std::pair{view, steep}, std::pair{steep, grazing}, std::pair{grazing, view}})
    expect_luminance(lit_plane(material, out, in, 1024), value(model, out, in), precision,
                     name + ", lit at " + std::to_string(in.z), precision);
}

TEST(MeanOfPlane, RoughLayers) {
  const CoatingVolume cloudy{0.5f, 0.4f, ConstantSpectrum{0.8f}, 30, 1};
  const LayerVolume volume{static_cast<double>(0.5f), static_cast<double>(0.4f), filled(0.8f), 30};
  expect_layers(
      Material{CoatedDiffuseMaterial{ConstantSpectrum{0.7f}, ConstantSpectrum{1.5f}, rough(0.3f), cloudy}},
      CoatedDiffuseBsdf{filled(0.7f), 1.5, facets(0.3, Masking::correlated), volume}, "coated diffuse", 0.02);
  expect_layers(Material{CoatedConductorMaterial{ComplexIndex{ConstantSpectrum{0.6f}, ConstantSpectrum{2.6f}},
                                                 rough(0.4f), ConstantSpectrum{1.5f}, rough(0.3f), cloudy}},
                CoatedConductorBsdf{filled(0.6f), filled(2.6f), facets(0.4, Masking::correlated), 1.5,
                                    facets(0.3, Masking::correlated), volume},
                "coated metal", 0.02);
}

// A lamp and the ways to it weigh 1 together where their densities are walks, too: the sky's light through
// connections and through samples, against samples alone.
TEST(MeanOfPlane, LayersUnderTheSky) {
  CoatedDiffuseMaterial m{ConstantSpectrum{1}, ConstantSpectrum{1.5f}, rough(0.2f), {}};
  m.volume = {0.5f, 0.0f, ConstantSpectrum{1}, 1000, 1};
  CoatedDiffuseBsdf b{filled(1), 1.5, facets(0.2, Masking::correlated)};
  b.volume = {0.5, 0, filled(1), 1000};
  double expected = 0;
  const int n = of_all(400, 200);
  const float step = 1 / static_cast<float>(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < 3; ++k)
        if (const auto s =
                sample(b, view, (static_cast<float>(k) + 0.5f) / 3,
                       {(static_cast<float>(i) + 0.5f) * step, (static_cast<float>(j) + 0.5f) * step}))
          expected += static_cast<double>(s->weight[0]) / (3 * n * n);
  expect_luminance(plane_under_sky(Material{m}, view, 1024), expected, 0.01, "cloudy", 5e-3);
}

// ---- Bumps

// A slope of 60° seen at 20°, from its side and from behind, where it is turned to the ray.
TEST(MeanOfPlane, SlopesOfBumpsFaceTheRay) {
  for (const double side : {0.0, 180.0}) {
    Scene scene;
    const Id<TriangleMesh> mesh = square(scene, 0, 1);  // dp/du = (2, 0, 0)
    scene.meshes[mesh.value].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const Spectrum low{ConstantSpectrum{0}}, high{ConstantSpectrum{2 * std::sqrt(3.0f)}};
    scene.textures = {{BilinearTexture{low, low, high, high, UvMapping{}}, true, "", {}}};
    Material material{DiffuseMaterial{ConstantSpectrum{0.6f}}};
    material.displacement = FloatParameter{Id<Texture>{0}};
    add_shape(scene, mesh, material);
    scene.lights.resize(1);
    scene.lights[0].model = DistantLight{-direction(60, side), ConstantSpectrum{1}};
    look_along(scene, direction(70, side));
    scene.settings.max_depth = 1;
    expect_luminance(mean_of(render(scene, of_all(256, 128)).film), 0.6 / pi, 5e-3,
                     fmt::format("from {}°", side), 2e-3);
  }
}

// ---- Light of one wavelength

TEST(MeanOfPlane, OfOneWavelength) {
  TabulatedSpectrum line{std::vector<float>(table_size)};
  constexpr std::size_t at = 200;  // 560 nm
  line.values[at] = 100;
  const double seen = 100 * static_cast<double>(cie_1931()[at][1]) / cie_y_integral_nm;
  CoatedDiffuseMaterial coated;
  coated.reflectance = ConstantSpectrum{0.8f};
  coated.volume.max_depth = 200;
  for (const auto& [material, value] :
       {std::pair{Material{DiffuseMaterial{ConstantSpectrum{0.8f}}}, 0.8 / pi * steep.z},
        std::pair{Material{coated}, smoothly_coated(0.8, 1.5, 0.01, view, steep)}}) {
    Scene scene;
    add_shape(scene, square(scene, 0), material);
    scene.lights.resize(1);
    scene.lights[0].model = DistantLight{-steep, line};
    look_along(scene, view);
    scene.settings.max_depth = 1;
    expect_luminance(mean_of(render(scene, of_all(1024, 512)).film), seen * value, 0.03,
                     "material " + std::to_string(material.model.index()), 2e-3);
  }
}

// ---- Colours that a tint makes of a base colour: a property of the colour, not of the wavelengths drawn

TEST(MeanOfPlane, TintsAreOfTheColour) {
  std::vector<std::array<double, 2>> base;
  for (double lambda = 360; lambda <= 830; ++lambda)
    base.push_back({lambda, 0.02 + 0.9 * std::clamp((lambda - 540) / 80, 0.0, 1.0)});
  const Spectrum color{tabulate(base, true)};
  PrincipledMaterial m;
  m.base_color = color, m.spec_tint = 1.0f, m.sheen = 1.0f, m.sheen_tint = 1.0f, m.roughness = 0.6f;
  const Vector3d in = direction(70, 205);
  for (const bool thin : {false, true}) {
    m.thin = thin;
    std::vector<std::array<double, 2>> seen;
    for (const auto& [lambda, reflectance] : base) {
      const SampledSpectrum c = filled(static_cast<float>(reflectance));
      PrincipledBsdf solid{.base_color = c, .luminance = luminance(color)};
      solid.roughness = static_cast<double>(0.6f), solid.spec_tint = solid.sheen = solid.sheen_tint = 1;
      PrincipledThinBsdf sheet{.base_color = c, .luminance = luminance(color)};
      sheet.roughness = static_cast<double>(0.6f), sheet.spec_tint = sheet.sheen = sheet.sheen_tint = 1;
      seen.push_back({lambda, thin ? value(sheet, view, in) : value(solid, view, in)});
    }
    const XYZ want = to_xyz(Spectrum{tabulate(seen, true)});
    const Mean found = lit_plane(Material{m}, view, in, 1024);
    expect_luminance(found, want.y, 2e-3, thin ? "sheet, Y" : "solid, Y", 4e-3);
    EXPECT_NEAR(found.value.x, want.x, 4.5 * found.error.x + 4e-3 * want.x);
    EXPECT_NEAR(found.value.z, want.z, 4.5 * found.error.z + 4e-3 * want.y);
  }
}

}  // namespace
}  // namespace vitrail::test::means_of_surfaces_test
