// SPDX-License-Identifier: Apache-2.0
// A film is the same whether paths are traced several at a time, in lanes of any width, or each by itself.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <functional>
#include <optional>

#include "bundle/loaded_domain.h"
#include "images/image_files.h"
#include "partitioner/partition.h"
#include "scene/geometry/portable_math.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tracer/transport/waves/lane_stages.h"
#include "tracer/transport/waves/tracer.h"

namespace vitrail::test::waves_test {
namespace {

struct Case {
  std::string name;
  std::function<void(Scene&)> change = {};
};

Material material(MaterialModel model, bool two_sided = true) {
  Material m{std::move(model)};
  m.two_sided = two_sided;
  return m;
}

void add_block(Scene& scene, const Material& m) {
  add_shape(scene, add_quads(scene, box_faces({-0.6f, -1, -0.1f}, {0.1f, -0.3f, 0.6f})), m);
}

void add_ball(Scene& scene, const Material& m, const std::optional<AreaLight>& light = std::nullopt) {
  scene.meshes.emplace_back().quadric = Quadric{.kind = QuadricKind::sphere};
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, m, light);
  scene.shapes.back().object_to_world = translate({0.4, -0.5, 0.1}) * scale({0.35, 0.35, 0.35});
}

ComplexIndex gold_index() { return {*named_spectrum("metal-Au-eta"), *named_spectrum("metal-Au-k")}; }

Material rough_gold(Roughness::Distribution distribution) {
  ConductorMaterial gold{gold_index()};
  gold.roughness.alpha_u = 0.2f, gold.roughness.alpha_v = 0.1f;
  gold.roughness.distribution = distribution;
  return material(gold);
}

Material plastic(float width) {
  PlasticMaterial p;
  p.diffuse_reflectance = Spectrum{reflectance_from_rgb({0.2f, 0.4f, 0.1f})};
  p.roughness.alpha_u = p.roughness.alpha_v = width;
  p.nonlinear = true;
  return material(p);
}

// As POV-Ray's `finish`.
Material finish(float brilliance, float specular) {
  FinishMaterial f{reflectance_from_rgb({0.2f, 0.3f, 0.6f}), ConstantSpectrum{0.8f}};
  f.brilliance = brilliance, f.specular = specular, f.phong = 0.3f;
  return material(f);
}

// Lamps as POV-Ray's, one of them without shadows; and direct light alone, as its scenes have without
// radiosity.
void add_points(Scene& scene) {
  scene.lights.push_back(Light{PointLight{{0.3, 0.2, -0.4}, ConstantSpectrum{1}}});
  scene.lights.push_back(Light{PointLight{{-0.5, 0.6, -0.5}, ConstantSpectrum{0.7f}}});
  scene.lights.back().casts_shadows = false;
  scene.settings.direct_only = true;
}

// Of a clear or cloudy coat over grey or gold, wide or smooth both.
Material coated(float coat, float base, bool is_metal = false, float albedo = 0) {
  CoatingVolume volume{.thickness = 0.3f, .g = 0.4f, .albedo = ConstantSpectrum{albedo}};
  volume.samples = albedo > 0 ? 2 : 1;
  Roughness on_top, below;
  on_top.alpha_u = on_top.alpha_v = coat, below.alpha_u = below.alpha_v = base;
  if (is_metal)
    return material(CoatedConductorMaterial{gold_index(), below, ConstantSpectrum{1.5f}, on_top, volume});
  return material(CoatedDiffuseMaterial{Spectrum{reflectance_from_rgb({0.2f, 0.4f, 0.8f})},
                                        ConstantSpectrum{1.5f}, on_top, volume});
}

Material principled(float metallic) {
  PrincipledMaterial p;
  p.base_color = Spectrum{reflectance_from_rgb({0.7f, 0.4f, 0.1f})};
  p.roughness = 0.3f, p.anisotropic = 0.4f, p.metallic = metallic;
  p.spec_tint = 0.5f, p.sheen = 0.5f, p.sheen_tint = 0.5f, p.flatness = 0.2f, p.clearcoat = 0.8f;
  p.clearcoat_gloss = 0.5f;
  return material(p);
}

SkyLight sun_and_sky(float sky_scale) {
  SkyLight light;
  light.light_to_world = rotate(-pi / 2, {1, 0, 0});
  light.to_sun = unit(Vector3d{0.3, 0.2, 0.8});
  light.sun_diameter_deg = 20;
  light.sky_scale = sky_scale;
  return light;
}

// Of two colours, with one texel of another brightness.
std::string image_file(const std::string& name, float brightness) {
  static const TemporaryDirectory directory;
  const std::string file = (directory / name).string();
  if (!std::filesystem::exists(file)) {
    Image image = black_image(8, 8, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = i % 5 == 0 ? 0.7f : 0.2f;
    image.values[8 * 3 * 2 + 7] = brightness;
    write_exr_image(file, image);
  }
  return file;
}

EnvironmentLight image_around(EnvironmentLight::Projection projection) {
  EnvironmentLight light;
  light.filename = image_file("around.exr", 50);
  light.light_to_world = rotate(-pi / 2, {1, 0, 0});
  light.projection = projection;
  return light;
}

// On a block and on a ball, an image each; the ball's texels are not blended where `nearest`.
std::function<void(Scene&)> pictures(TextureFilter of_ball) {
  return [of_ball](Scene& s) {
    const auto painted = [&](const std::string& name, float brightness, TextureFilter filter) {
      ImageTexture image;
      image.filename = image_file(name, brightness);
      image.mapping = UvMapping{1.5f, 0.5f, 0.1f, -0.3f, 2, 0.7f};
      image.wrap = Wrap::mirror;
      image.filter = filter;
      s.textures.push_back({image, false, "", {}});
      return material(DiffuseMaterial{Id<Texture>{static_cast<std::uint32_t>(s.textures.size() - 1)}});
    };
    add_block(s, painted("block.exr", 0.9f, TextureFilter::bilinear));
    TriangleMesh& block = s.meshes.back();
    for (const Point3f& p : block.positions) block.uvs.push_back({2 * p.x + p.z, p.y - p.z});
    add_ball(s, painted("ball.exr", 0.1f, of_ball));
  };
}

// Without its front and its ceiling.
std::function<void(Scene&)> under(std::vector<LightModel> lights) {
  return [lights](Scene& s) {
    s.meshes[0].triangles.resize(6);
    for (const LightModel& light : lights) s.lights.push_back(Light{light});
  };
}

void tinted_sheets(Scene& s) {
  pictures(TextureFilter::bilinear)(s);
  add_ball(s, rough_gold(Roughness::Distribution::ggx));
  ThinDielectricMaterial sheet;
  sheet.transmittance_factor = Spectrum{reflectance_from_rgb({0.9f, 0.5f, 0.1f})};
  add_shape(s, add_quads(s, box_faces({-0.5f, -0.5f, -0.6f}, {0.5f, 0.5f, -0.5f})), material(sheet));
  s.shapes.back().opacity = 0.6f;
  sheet.reflectance_factor = Id<Texture>{0}, sheet.exterior_eta = ConstantSpectrum{1.2f};
  add_shape(s, add_quads(s, box_faces({-0.9f, -0.9f, -0.4f}, {0, 0, -0.3f})), material(sheet));
  s.materials.back().normal_map = Id<Texture>{0};
  s.lights.push_back(Light{PointLight{{0.3, 0.2, -0.8}, ConstantSpectrum{1}}});
}

std::vector<Case> cases() {
  const auto block = [](const Material& m) { return [m](Scene& s) { add_block(s, m); }; };
  const auto ball = [](const Material& m) { return [m](Scene& s) { add_ball(s, m); }; };
  const auto light = [](const LightModel& l) {
    return [l](Scene& s) {
      add_block(s, material(DiffuseMaterial{}));
      s.lights.push_back(Light{l});
    };
  };
  return {
      {"grey"},
      {"a colour", block(material(DiffuseMaterial{reflectance_from_rgb({0.9f, 0.2f, 0.1f})}))},
      {"black", block(material(DiffuseMaterial{reflectance_from_rgb({0, 0, 0})}))},
      {"one-sided", block(material(DiffuseMaterial{}, false))},
      {"grooves", block(material(DiffuseMaterial{ConstantSpectrum{0.5f}, 20.0f}))},
      {"mirror", block(material(ConductorMaterial{PerfectReflector{}}))},
      {"gold", block(material(ConductorMaterial{gold_index()}))},
      {"rough gold", block(rough_gold(Roughness::Distribution::ggx))},
      {"rough gold, Beckmann", block(rough_gold(Roughness::Distribution::beckmann))},
      {"metals by a reflectance and by indices side by side",
       [](Scene& s) {
         ConductorMaterial red{NormalReflectance{reflectance_from_rgb({0.9f, 0.2f, 0.1f})}};
         red.roughness.alpha_u = red.roughness.alpha_v = 0.2f;
         add_block(s, material(red));
         ConductorMaterial gold{gold_index()};
         gold.roughness.alpha_u = gold.roughness.alpha_v = 0.3f;
         gold.reflectance_factor = Spectrum{RgbUnboundedSpectrum{{0, -0.01f, 5}, 1.5f}};
         add_ball(s, material(gold));
       }},
      {"lamps and surfaces of all kinds of spectra",
       [](Scene& s) {
         add_ball(s, material(DiffuseMaterial{BlackbodySpectrum{5000, 0.2f}}),
                  AreaLight{.radiance = emission_from_rgb({4, 2, 1}), .scale = 0.7f});
         add_block(s, material(DiffuseMaterial{*named_spectrum("metal-Au-k")}));
         add_shape(s, add_quads(s, box_faces({-0.9f, -0.9f, 0.2f}, {-0.7f, -0.7f, 0.4f})),
                   material(DiffuseMaterial{}), AreaLight{.radiance = BlackbodySpectrum{3000, 2}});
       }},
      {"plastic", block(plastic(0))},
      {"rough plastic", block(plastic(0.2f))},
      {"coated", block(coated(0, 0))},
      {"coated, rough", block(coated(0.2f, 0))},
      {"coated, cloudy", block(coated(0, 0, false, 0.8f))},
      {"coated, rough and cloudy, beside a smooth one",
       [](Scene& s) {
         add_block(s, coated(0.3f, 0, false, 0.8f));
         add_ball(s, coated(0, 0));
       }},
      {"coated gold, smooth", block(coated(0, 0, true))},
      {"coated gold, rough", block(coated(0, 0.2f, true))},
      {"coated gold, all rough and cloudy", block(coated(0.2f, 0.1f, true, 0.5f))},
      {"principled", block(principled(0.3f))},
      {"principled as glTF has it", block(material(PrincipledMaterial{.metallic = 0.3f, .below = true}))},
      {"glass", block(material(DielectricMaterial{ConstantSpectrum{1.5f}}))},
      {"glass that disperses", block(material(DielectricMaterial{bk7()}))},
      {"frosted glass", block(material([] {
         DielectricMaterial d;
         d.roughness.alpha_u = d.roughness.alpha_v = 0.2f;
         return d;
       }()))},
      {"frosted glass of colours and by a map, and what scatters like it",
       [](Scene& s) {
         pictures(TextureFilter::bilinear)(s);
         DielectricMaterial d;
         d.roughness.alpha_u = 0.1f, d.roughness.alpha_v = 0.4f;
         d.roughness.distribution = Roughness::Distribution::beckmann;
         d.transmittance_factor = Spectrum{reflectance_from_rgb({0.9f, 0.5f, 0.1f})};
         s.materials.back() = material(d, false);  // of the ball
         s.materials.back().normal_map = Id<Texture>{0};
         d.reflectance_factor = Id<Texture>{0};
         s.materials[s.materials.size() - 2] = material(d, false);
         PrincipledMaterial clear;
         clear.spec_trans = 0.7f, clear.eta = 1.4f, clear.roughness = 0.3f;
         add_shape(s, add_quads(s, box_faces({0.3f, -1, 0.3f}, {0.7f, -0.6f, 0.7f})), material(clear, false));
         add_shape(s, add_quads(s, box_faces({-0.9f, -1, 0.3f}, {-0.7f, -0.6f, 0.7f})), principled(0.3f));
         s.meshes[0].triangles.resize(8);
         s.lights.push_back(Light{DistantLight{{0.3, -0.5, 0.8}, ConstantSpectrum{1}}});
       }},
      {"tinted glass, by a spectrum and by a map",
       [](Scene& s) {
         pictures(TextureFilter::bilinear)(s);
         DielectricMaterial d{ConstantSpectrum{1.5f}};
         d.transmittance_factor = Spectrum{reflectance_from_rgb({0.9f, 0.5f, 0.1f})};
         s.materials.back() = material(d, false);  // of the ball
         d.reflectance_factor = Id<Texture>{0}, d.transmittance_factor = Id<Texture>{0};
         add_shape(s, add_quads(s, box_faces({0.3f, -1, 0.3f}, {0.7f, -0.6f, 0.7f})), material(d, false));
         add_shape(s, add_quads(s, box_faces({-0.9f, -1, 0.3f}, {-0.7f, -0.6f, 0.7f})),
                   material(DielectricMaterial{ConstantSpectrum{1.5f}}));
       }},
      {"glass in glass",
       [](Scene& s) {
         const auto add = [&](Point3f low, Point3f high, float eta) {
           add_shape(s, add_quads(s, box_faces(low, high)),
                     material(DielectricMaterial{ConstantSpectrum{eta}}));
         };
         add({-0.6f, -0.9f, -0.1f}, {0.6f, 0.5f, 0.6f}, 1.5f);
         add({-0.5f, -0.8f, 0}, {0.5f, 0.4f, 0.5f}, 1.3f);
         s.meshes[0].triangles.resize(2);
         s.lights.push_back(Light{InfiniteLight{ConstantSpectrum{0.5f}}});
         s.settings.max_depth = 2;
       }},
      {"a ball of glass behind one that disperses",
       [](Scene& s) {
         add_block(s, material(DielectricMaterial{bk7()}));
         add_ball(s, material(DielectricMaterial{ConstantSpectrum{1.3f}}));
       }},
      {"a ball of glass", ball(material(DielectricMaterial{ConstantSpectrum{1.5f}}))},
      {"a ball of gold", ball(rough_gold(Roughness::Distribution::ggx))},
      {"a ball of plastic", ball(plastic(0.1f))},
      {"a ball of principled metal", ball(principled(1))},
      {"a lamp that is a ball",
       [](Scene& s) { add_ball(s, material(DiffuseMaterial{}), AreaLight{ConstantSpectrum{4}}); }},
      {"a lamp around all, and one that is a ball",
       [](Scene& s) {
         s.meshes[0].triangles.resize(8);
         add_ball(s, material(DiffuseMaterial{}), AreaLight{.radiance = ConstantSpectrum{4}});
         add_ball(s, material(DiffuseMaterial{}),
                  AreaLight{.radiance = ConstantSpectrum{0.5f}, .two_sided = true});
         s.shapes.back().object_to_world = translate({0.2, 0.1, 0}) * scale({5, 4, -6});
       }},
      {"a point", light(PointLight{{0.3, 0.2, -0.4}, ConstantSpectrum{1}})},
      {"spots, points that fade and distant lights",
       [](Scene& s) {
         add_block(s, finish(1, 0.5f));
         add_ball(s, rough_gold(Roughness::Distribution::ggx));
         s.meshes[0].triangles.resize(8);
         using Falloff = SpotLight::Falloff;
         for (const auto falloff : {Falloff::smoothstep, Falloff::linear, Falloff::quartic}) {
           SpotLight spot;
           spot.intensity = emission_from_rgb({1, 0.7f, 0.3f});
           spot.falloff = falloff, spot.cutoff_deg = 60, spot.beam_deg = 20;
           spot.tightness = falloff == Falloff::linear ? 3.0f : 0.0f;
           spot.light_to_world = translate({0.2, 0.8, -0.1}) * rotate(pi / 2 + 0.3, {1, 0, 0});
           s.lights.push_back(Light{spot});
         }
         for (const float power : {0.0f, 1.5f, 2.0f})
           s.lights.push_back(
               Light{PointLight{{-0.5, 0.6, -0.5}, ConstantSpectrum{0.7f}, Fading{0.5f, power}}});
         s.lights.push_back(Light{DistantLight{{0.3, -0.5, 0.8}, emission_from_rgb({1, 2, 3})}});
         s.lights.push_back(Light{DistantLight{{-0.3, -0.5, 0.8}, BlackbodySpectrum{4000, 1}}});
       }},
      {"no lamp", [](Scene& s) { s.shapes.pop_back(); }},
      {"hidden lamps",
       [](Scene& s) {
         s.meshes[0].triangles.resize(8);
         add_block(s, material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         add_ball(s, material(DiffuseMaterial{}), AreaLight{ConstantSpectrum{4}});
         s.lights.push_back(Light{InfiniteLight{ConstantSpectrum{0.5f}}});
         s.settings.hides_emitters = true;
       }},
      {"an open box under a sky",
       [](Scene& s) {
         s.meshes[0].triangles.resize(8);
         s.lights.push_back(Light{InfiniteLight{ConstantSpectrum{0.5f}}});
         s.lights.push_back(Light{DistantLight{{0.3, -0.5, 0.8}, ConstantSpectrum{1}}});
       }},
      {"an open box under a sun and a sky", under({sun_and_sky(1)})},
      {"under a sun alone", under({sun_and_sky(0)})},
      {"under an image", under({image_around(EnvironmentLight::Projection::latitude_longitude)})},
      {"under two images, a sky and a constant light",
       under({image_around(EnvironmentLight::Projection::latitude_longitude), InfiniteLight{bk7()},
              image_around(EnvironmentLight::Projection::equal_area), sun_and_sky(1)})},
      {"a sheet with holes before an image",
       [](Scene& s) {
         add_block(s, plastic(0.1f));
         s.shapes.back().opacity = 0.4f;
         under({image_around(EnvironmentLight::Projection::equal_area)})(s);
       }},
      {"a sun and a sky behind glass",
       [](Scene& s) {
         add_block(s, material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         under({sun_and_sky(1)})(s);
       }},
      {"parallel rays, a filter with lobes",
       [](Scene& s) {
         const auto to_world = std::get<PerspectiveCamera>(s.camera).camera_to_world;
         s.camera = OrthographicCamera{to_world, {-1, 1, -1, 1}, {}};
         s.film.filter = MitchellFilter{};
       }},
      {"a wide picture, a filter that is uneven",
       [](Scene& s) {
         s.film.width = 41, s.film.crop = {0, 41, 0, s.film.height};
         s.film.filter = GaussianFilter{};
       }},
      {"a lens",
       [](Scene& s) {
         std::get<PerspectiveCamera>(s.camera).lens = {0.05, 1.2};
       }},
      {"a sheet with holes",
       [](Scene& s) {
         add_block(s, plastic(0.1f));
         s.shapes.back().opacity = 0.4f;
         add_ball(s, rough_gold(Roughness::Distribution::ggx));
       }},
      {"a sheet of glass and a sun",
       [](Scene& s) {
         add_block(s, material(ThinDielectricMaterial{}));
         s.meshes[0].triangles.resize(8);
         s.lights.push_back(Light{DistantLight{{0.3, -0.5, 0.8}, ConstantSpectrum{1}}});
       }},
      {"sheets of tinted glass before things of all kinds, and by a map", tinted_sheets},
      {"the same where passing them counts for nothing",
       [](Scene& s) {
         tinted_sheets(s);
         s.settings.straight_counts = false;
       }},
      {"a pane and a sun",
       [](Scene& s) {
         add_block(s, material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         s.meshes[0].triangles.resize(8);
         s.lights.push_back(Light{DistantLight{{0.3, -0.5, 0.8}, ConstantSpectrum{1}}});
       }},
      {"a ball of fog",
       [](Scene& s) {
         Medium mist;
         mist.coefficients = AbsorptionScattering{ConstantSpectrum{0.3f}, ConstantSpectrum{2}};
         s.media.push_back(mist);
         add_ball(s, material(DielectricMaterial{ConstantSpectrum{1.3f}}));
         s.shapes.back().interior = Id<Medium>{0};
         add_block(s, plastic(0));
       }},
      {"a room of fog that is the denser towards blue, with things in it",
       [](Scene& s) {
         Medium mist;
         mist.coefficients = AbsorptionScattering{ConstantSpectrum{0.05f},
                                                  Spectrum{reflectance_from_rgb({0.2f, 0.3f, 0.5f})}};
         mist.g = 0.6f;
         s.media.push_back(mist);
         add_ball(s, rough_gold(Roughness::Distribution::ggx));
         add_block(s, plastic(0.2f));
         s.camera_medium = Id<Medium>{0};
       }},
      {"glass that absorbs, and fog of many lamps under a sky",
       [](Scene& s) {
         Medium dye, mist;
         dye.coefficients =
             AbsorptionScattering{Spectrum{reflectance_from_rgb({0.1f, 0.4f, 0.9f})}, ConstantSpectrum{0}};
         mist.coefficients = AbsorptionScattering{ConstantSpectrum{0.1f}, ConstantSpectrum{3}};
         s.media = {dye, mist};
         add_ball(s, material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         s.shapes.back().interior = Id<Medium>{0};
         add_block(s, material(InterfaceMaterial{}));
         s.shapes.back().interior = Id<Medium>{1};
         s.meshes[0].triangles.resize(8);
         s.lights.push_back(Light{PointLight{{0.3, 0.2, -0.4}, ConstantSpectrum{1}}});
         s.lights.push_back(Light{sun_and_sky(1)});
         s.settings.max_depth = 20;
       }},
      {"two liquids, one before the other",
       [](Scene& s) {
         DielectricMaterial water{ConstantSpectrum{1.3f}}, glass{ConstantSpectrum{1.5f}};
         water.priority = 1, glass.priority = 2;
         add_block(s, material(water));
         add_ball(s, material(glass));
       }},
      {"pictures", pictures(TextureFilter::bilinear)},
      {"normals by a map",
       [](Scene& s) {
         pictures(TextureFilter::bilinear)(s);
         s.materials.back() = principled(0.3f);  // of the ball
         for (Material& m : s.materials) m.normal_map = Id<Texture>{0};
       }},
      {"bumps",
       [](Scene& s) {
         pictures(TextureFilter::bilinear)(s);
         s.materials.back() = plastic(0.2f);
         for (Material& m : s.materials) m.displacement = FloatParameter{Id<Texture>{0}};
       }},
      {"pictures, one of squares", pictures(TextureFilter::nearest)},
      {"layers of first surfaces",
       [](Scene& s) {
         s.film.layers.bits = all_layers;
         add_block(s, principled(0.3f));
         add_ball(s, material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         under({sun_and_sky(1)})(s);
       }},
      {"finishes", block(finish(1, 0.6f))},
      {"direct light",
       [](Scene& s) {
         add_block(s, plastic(0));
         add_ball(s, material(ConductorMaterial{gold_index()}));
         s.settings.direct_only = true;
       }},
      {"direct light by glass, before an image",
       [](Scene& s) {
         add_block(s, finish(2, 0));
         add_ball(s, material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         under({image_around(EnvironmentLight::Projection::latitude_longitude)})(s);
         s.settings.direct_only = true;
       }},
      {"direct light of points alone",
       [](Scene& s) {
         add_block(s, finish(1.5f, 0.5f));
         add_ball(s, plastic(0));
         s.area_lights[0].sampled = false;
         add_points(s);
       }},
      {"direct light of points and a lamp",
       [](Scene& s) {
         add_block(s, finish(1, 0.5f));
         add_ball(s, material(ConductorMaterial{gold_index()}));
         add_points(s);
       }},
      {"a point without shadows",
       [](Scene& s) {
         add_ball(s, finish(1, 0.5f));
         add_points(s);
         s.settings.direct_only = false;
       }},
      {"two sides, a blend and masks",
       [](Scene& s) {
         const auto of = [&](Material m) {
           s.materials.push_back(std::move(m));
           return Id<Material>{static_cast<std::uint32_t>(s.materials.size() - 1)};
         };
         pictures(TextureFilter::bilinear)(s);
         const Id<Material> painted = of(s.materials.back()), shiny = of(plastic(0.2f)),
                            gold = of(rough_gold(Roughness::Distribution::ggx)),
                            one_sided = of(principled(0)),
                            glass = of(material(DielectricMaterial{ConstantSpectrum{1.5f}}));
         s.materials[one_sided.value].two_sided = false;
         const Id<Material> blend = of(material(BlendMaterial{painted, shiny, Id<Texture>{0}})),
                            coat = of(material(BlendMaterial{blend, glass, 0.2f}));
         s.shapes[0].material = of(material(TwoSidedMaterial{blend, gold}));
         s.shapes[s.shapes.size() - 2].material = of(material(MaskMaterial{0.6f, one_sided}));
         s.shapes.back().material = of(material(MaskMaterial{Id<Texture>{1}, coat}));
         under({sun_and_sky(1)})(s);
       }},
      {"a lamp with holes, and what counts its passing",
       [](Scene& s) {
         s.materials.push_back(plastic(0.1f));
         add_ball(
             s,
             material(MaskMaterial{0.5f, Id<Material>{static_cast<std::uint32_t>(s.materials.size() - 1)}}),
             AreaLight{.radiance = ConstantSpectrum{4}, .two_sided = true});
         s.settings.straight_counts = true;
       }},
      {"bumps of patterns",
       [](Scene& s) {
         PatternTexture wrinkles;
         wrinkles.kind = PatternTexture::Kind::wrinkles;
         wrinkles.map = {{0, ConstantSpectrum{0}}, {1, ConstantSpectrum{0.3f}}};
         wrinkles.texture_to_world = scale({0.1, 0.1, 0.1});
         s.textures.push_back({wrinkles, true, "", {}});
         add_block(s, finish(1.5f, 0.5f));
         add_ball(s, plastic(0.2f));
         for (Material& m : s.materials)
           m.displacement = FloatParameter{Id<Texture>{static_cast<std::uint32_t>(s.textures.size() - 1)}};
       }},
      {"to the end",
       [](Scene& s) {
         add_block(s, plastic(0.2f));
         s.settings.max_depth = 300;
       }},
  };
}

class Waves : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    Scene scene = lit_box(20);
    scene.settings.max_depth = 6;
    if (GetParam().change) GetParam().change(scene);
    partition(scene, bundle_, {});
    scene_.emplace(read_manifest(bundle_), bundle_, 1 << 20, 3);
    domain_ = load_domain(scene_->manifest, bundle_, 0);
  }

  // Hash of the film, rays of each kind.
  std::string trace(const LaneStages* stages) {
    Film film(scene_->manifest.film, {});
    Outbox outbox;
    TraceCounters counters;
    Wave wave;
    const DomainView* const view = &domain_->view();
    Tracer tracer({.scene = *scene_,
                   .resident = ResidentViews(&view, 1),
                   .film = film,
                   .outbox = outbox,
                   .counters = counters,
                   .stages = stages},
                  wave);
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x)
        for (std::uint32_t s = 0; s < 6; ++s) tracer.trace_camera(x, y, s);
    tracer.finish();
    EXPECT_EQ(counters.born, counters.died);
    EXPECT_EQ(film.refused(), Refused{});
    return fmt::format("{:016x} {} {} {}", film.hash(), counters.rays_camera, counters.rays_indirect,
                       counters.rays_shadow);
  }

  TemporaryDirectory directory_;
  std::filesystem::path bundle_ = directory_ / "scene.vit";
  std::optional<RenderScene> scene_;
  std::shared_ptr<const LoadedDomain> domain_;
};

TEST_P(Waves, GiveTheFilmOfPathsByThemselves) {
  const std::string alone = trace(nullptr);
  for (const Kernel kernel : available_kernels())
    EXPECT_EQ(trace(&lane_stages(kernel)), alone) << name(kernel);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Waves, ::testing::ValuesIn(cases()), [](const auto& one) {
  std::string name = one.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace vitrail::test::waves_test
