// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <numbers>

#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/conformance/gate/scene_parts.h"

namespace vitrail::test {

namespace {

using S = SceneParts;

Spectrum shining(double r, double g, double b) { return emission_from_rgb({r, g, b}); }
// At the upper left in front, towards the object.
Transform from_above() { return look_at({-1.5, 2, 3}, {0, 0, 0}, {0, 1, 0}); }

Spectrum lines() {
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i) table.values.push_back(i > 150 && i < 300 ? 3.0f : 0.5f);
  return table;
}

// A square of 1.2 in the picture, left of the object, which looks to the right and to the camera.
void lamp(S& s, AreaLight light) {
  TriangleMesh mesh;
  mesh.positions = {{-0.6f, -0.6f, 0}, {0.6f, -0.6f, 0}, {0.6f, 0.6f, 0}, {-0.6f, 0.6f, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Shape shape;
  shape.mesh = s.add(std::move(mesh));
  shape.material = s.add(Material{DiffuseMaterial{Spectrum{ConstantSpectrum{0.2f}}}});
  shape.object_to_world = translate({-1.2, 0.7, 0.6}) * rotate(0.6, {0, 1, 0});
  shape.area_light = Id<AreaLight>{static_cast<std::uint32_t>(s.scene.area_lights.size())};
  s.scene.area_lights.push_back(std::move(light));
  s.scene.shapes.push_back(std::move(shape));
}

SpotLight spot(SpotLight::Falloff falloff) {
  SpotLight light;
  light.light_to_world = from_above();
  light.intensity = shining(20, 18, 15);
  light.beam_deg = 12, light.cutoff_deg = 24;
  light.falloff = falloff;
  return light;
}

EnvironmentLight sky(const S& s, EnvironmentLight::Projection projection) {
  EnvironmentLight light;
  const bool square = projection == EnvironmentLight::Projection::equal_area;
  light.filename = s.image(square ? "octahedron.exr" : "sky.exr");
  light.light_to_world = rotate(0.7, {1, 0.2, 0.1});
  light.projection = projection;
  light.scale = ConstantSpectrum{1.5f};
  return light;
}

Id<Texture> picture(S& s, const char* name, TextureFilter filter = TextureFilter::bilinear) {
  ImageTexture image;
  image.filter = filter;
  image.filename = s.image(name);
  return s.add(image, false);
}

ProjectionLight projector(S& s, bool irradiance) {
  ProjectionLight light;
  light.light_to_world = from_above();
  light.image = picture(s, "b.png", irradiance ? TextureFilter::bilinear : TextureFilter::nearest);
  light.scale = ConstantSpectrum{20};
  light.fov_deg = 40;
  light.irradiance = irradiance;
  return light;
}

// What the object itself gives off.
void shine(S& s, bool two_sided) {
  AreaLight light{shining(1, 0.8, 0.5)};
  light.two_sided = two_sided;
  s.scene.area_lights.push_back(light);
}

constexpr std::array lights{
    LightValue{"point",
               [](S& s) {
                 s.add(PointLight{{-1.5, 2, 3}, shining(9, 8, 7)});
               }},
    LightValue{"blackbody",
               [](S& s) {
                 s.add(PointLight{{-1.5, 2, 3}, BlackbodySpectrum{3000, 8}});
               }},
    LightValue{"lines",
               [](S& s) {
                 s.add(PointLight{{1.5, 2, 3}, scaled(lines(), 4)});
               }},
    LightValue{"named",
               [](S& s) {
                 s.add(PointLight{{1.5, 2, 3}, NamedSpectrum{"stdillum-F2"}});
               }},
    LightValue{"soft spot", [](S& s) { s.add(spot(SpotLight::Falloff::smoothstep)); }},
    LightValue{"linear spot", [](S& s) { s.add(spot(SpotLight::Falloff::linear)); }},
    LightValue{"old spot", [](S& s) { s.add(spot(SpotLight::Falloff::quartic)); }},
    LightValue{"textured spot",
               [](S& s) {
                 SpotLight light = spot(SpotLight::Falloff::linear);
                 light.texture = picture(s, "b.png");
                 s.add(light);
               }},
    LightValue{"distant",
               [](S& s) {
                 s.add(DistantLight{normalize(Vector3d{0.3, -0.5, -1}), shining(2, 2.2, 2.5)});
               }},
    LightValue{"infinite", [](S& s) { s.add(InfiniteLight{shining(0.6, 0.7, 0.9)}); }},
    LightValue{"two infinite",
               [](S& s) {
                 s.add(InfiniteLight{shining(0.6, 0.3, 0.2)});
                 s.add(InfiniteLight{shining(0.1, 0.3, 0.5)});
               }},
    LightValue{"sky", [](S& s) { s.add(sky(s, EnvironmentLight::Projection::latitude_longitude)); }},
    LightValue{"octahedron", [](S& s) { s.add(sky(s, EnvironmentLight::Projection::equal_area)); }},
    LightValue{"sky and infinite",
               [](S& s) {
                 s.add(sky(s, EnvironmentLight::Projection::latitude_longitude));
                 s.add(InfiniteLight{shining(0.1, 0.3, 0.5)});
               }},
    LightValue{"coloured sky",
               [](S& s) {
                 EnvironmentLight light = sky(s, EnvironmentLight::Projection::latitude_longitude);
                 light.scale = unbounded_from_rgb({2, 1, 0.5});
                 s.add(light);
               }},
    LightValue{"area", [](S& s) { lamp(s, {shining(6, 5, 4)}); }},
    LightValue{"spectral area", [](S& s) { lamp(s, {scaled(lines(), 2)}); }},
    LightValue{"two-sided area",
               [](S& s) {
                 AreaLight light{shining(6, 5, 4)};
                 light.two_sided = true;
                 lamp(s, light);
               }},
    LightValue{"image area",
               [](S& s) {
                 lamp(s, {picture(s, "a.png"), 9});
               }},
    LightValue{"linear image area",
               [](S& s) {
                 lamp(s, {picture(s, "a.exr"), 9});
               }},
    LightValue{"turned image area",
               [](S& s) {
                 ImageTexture image;
                 image.filename = s.image("a.png");
                 image.mapping = UvMapping{0, 1, 0, -1, 0, 1};
                 lamp(s, {s.add(image, false), 9});
               }},
    LightValue{"board area",
               [](S& s) {
                 const Spectrum dark = ConstantSpectrum{0.1f}, bright = ConstantSpectrum{0.9f};
                 lamp(s, {s.add(CheckerboardTexture{dark, bright, UvMapping{2, 0, 0, 0, 3, 0}}, false), 9});
               }},
    LightValue{"directional area",
               [](S& s) {
                 AreaLight light{shining(6, 5, 4)};
                 light.directional = true;
                 lamp(s, light);
               }},
    LightValue{"pbrt projector", [](S& s) { s.add(projector(s, false)); }},
    LightValue{"Mitsuba projector", [](S& s) { s.add(projector(s, true)); }},
    LightValue{"goniometric",
               [](S& s) {
                 GoniometricLight light;
                 light.light_to_world = from_above();
                 light.intensity = shining(20, 18, 15);
                 light.filename = s.image("lamp.exr");
                 s.add(light);
               }},
    LightValue{"object shines", [](S& s) { shine(s, false); }},
    LightValue{"object shines on both sides", [](S& s) { shine(s, true); }},
};

}  // namespace

std::span<const LightValue> light_values() { return lights; }

}  // namespace vitrail::test
