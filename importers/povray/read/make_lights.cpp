// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "scene/geometry/frame.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

constexpr int most_lights = 8;  // of an area_light, along each axis

// The places of the lights of an area_light, around its middle.
std::vector<Vector3d> grid_of(const LightShape& light) {
  std::vector<Vector3d> offsets;
  const int n = std::min(light.count1, most_lights), m = std::min(light.count2, most_lights);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = n > 1 ? i / (n - 1.0) - 0.5 : 0, v = m > 1 ? j / (m - 1.0) - 0.5 : 0;
      if (light.circular && u * u + v * v > 0.2501) continue;
      offsets.push_back(light.axis1 * u + light.axis2 * v);
    }
  if (offsets.empty()) offsets.push_back({});
  return offsets;
}

}  // namespace

void SceneMaker::add_light(const Object& object, const LightShape& light, const Transform& to_world) {
  const SourceLocation place = reader_.location(object.place);
  const Point3d at = transform_point(to_world, light.position),
                target = transform_point(to_world, light.point_at);
  if (light.shadowless && reader_.for_export)
    reader_.notes.approximated("shadowless: the light has shadows", place);
  if (light.projected) reader_.notes.dropped("projected_through", place);
  if (std::optional<AreaLamp> lamp = area_lamp(light, to_world)) {
    lamp->place = object.place;
    return lamps_.push_back(*lamp);
  }
  const std::vector<Vector3d> offsets = light.area ? grid_of(light) : std::vector<Vector3d>{{}};
  const double share = std::numbers::pi / static_cast<double>(offsets.size());
  const RGB color{reader_.linear(light.color.v[0]) * share, reader_.linear(light.color.v[1]) * share,
                  reader_.linear(light.color.v[2]) * share};
  if (!(std::max({color.r, color.g, color.b}) > 0)) return;
  if (std::min({light.color.v[0], light.color.v[1], light.color.v[2]}) < 0)
    reader_.notes.approximated("a light of negative colour: 0", place);
  if (light.area && (light.count1 > most_lights || light.count2 > most_lights))
    reader_.notes.approximated("area_light: a grid of eight lights along an axis", place);
  const Spectrum intensity = emission_from_rgb(color);
  const Fading fading{static_cast<float>(light.fade_distance), static_cast<float>(light.fade_power)};
  const Vector3d axis = target - at;
  const bool aims = length(axis) > 0;
  for (const Vector3d& offset : offsets) {
    const Point3d from = at + transform_vector(to_world, offset);
    Light made;
    made.origin = origin(object.place);
    made.casts_shadows = !light.shadowless || reader_.for_export;
    if (light.kind == LightShape::Kind::point || !aims) {
      PointLight point{from, intensity, fading};
      if (light.parallel && aims) {  // far away, in front of what is around
        point.position = target - normalize(axis) * reach_;
        point.fading = Fading{};
        reader_.notes.approximated("parallel: a light that is far away", place);
      }
      made.model = point;
    } else {
      SpotLight spot;
      spot.light_to_world = translate(from - Point3d{}) * transform_of(Frame(normalize(axis)));
      spot.intensity = intensity;
      spot.fading = fading;
      if (light.kind == LightShape::Kind::cylinder) {
        reader_.notes.approximated("a cylinder of light: the cone that is as wide at point_at", place);
        const auto angle = [&](double radius) {
          return static_cast<float>(std::atan(radius / length(axis)) * 180 / std::numbers::pi);
        };
        spot.beam_deg = angle(std::min(light.radius_deg, light.falloff_deg)),
        spot.cutoff_deg = angle(light.falloff_deg);
      } else {
        // A radius beyond the falloff is the edge of the light, as povray shows.
        const double edge = std::max(light.falloff_deg, light.radius_deg);
        spot.cutoff_deg = static_cast<float>(std::clamp(edge, 0.01, 90.0));
        spot.beam_deg =
            static_cast<float>(std::clamp(light.radius_deg, 0.0, static_cast<double>(spot.cutoff_deg)));
        spot.tightness = static_cast<float>(light.tightness);
      }
      made.model = spot;
    }
    scene_.lights.push_back(std::move(made));
  }
}

void SceneMaker::add_surroundings() {
  SpectrumParameter radiance = Spectrum{ConstantSpectrum{0}};
  Place place = world_.background_place;
  const auto is_black = [&] {
    const auto* s = std::get_if<Spectrum>(&radiance);
    return s && luminance(*s) == 0;
  };
  if (world_.background)
    radiance = Spectrum{
        emission_from_rgb({reader_.linear(world_.background->v[0]), reader_.linear(world_.background->v[1]),
                           reader_.linear(world_.background->v[2])})};
  const Point3d eye = world_.camera ? Point3d{} + world_.camera->location : Point3d{};
  const double radius = 4 * reach_;
  const Transform sphere = translate(eye - Point3d{}) * scale({radius, radius, radius});
  if (world_.sky && !world_.sky->pigments.empty()) {
    place = world_.sky->place;
    radiance = surfaces_.radiance_of(world_.sky->pigments, sphere);
  }
  // Fog without end hides it.
  const bool hidden = !fogs_.empty() && std::ranges::none_of(fogs_, [](const Shared<Fog>& fog) {
    return fog->ground || fog->color.v[4] > 0;
  });
  if (is_black() || (hidden && !world_.radiosity)) return;
  const auto* const constant = std::get_if<Spectrum>(&radiance);
  if (world_.radiosity && constant) {
    scene_.lights.push_back({InfiniteLight{*constant}, origin(place)});
    return;
  }
  // A sphere that is seen and lights nothing but what mirrors and paths bring.
  AreaLight glow;
  glow.radiance = radiance;
  glow.two_sided = true;
  glow.sampled = world_.radiosity;
  glow.origin = origin(place);
  scene_.area_lights.push_back(std::move(glow));
  Material black;
  black.model = DiffuseMaterial{Spectrum{ConstantSpectrum{0}}};
  scene_.materials.push_back(std::move(black));
  Shape shape;
  shape.mesh = quadric_mesh({QuadricKind::sphere});
  shape.material = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  shape.area_light = Id<AreaLight>{static_cast<std::uint32_t>(scene_.area_lights.size() - 1)};
  shape.object_to_world = sphere;
  shape.origin = origin(place);
  scene_.shapes.push_back(std::move(shape));
  reader_.notes.approximated("what is around the scene: a large sphere that is seen",
                             reader_.location(place));
}

bool SceneMaker::hides_surroundings(const Object& object) const {
  if (!object.no_shadow || !object.no_reflection || !object.no_radiosity || object.no_image) return false;
  const auto* const ball = std::get_if<SphereShape>(&object.shape);
  return ball && is_invertible(object.to_parent) &&
         length(transform_point(inverse(object.to_parent), eye()) - ball->center) < ball->radius;
}

bool SceneMaker::is_there(const Look& look, bool glows, const Object& object, const Target& target) {
  if (!look.no_image) {
    sees_glow_ = sees_glow_ || glows;
    return true;
  }
  const bool lights = glows && &target.shapes == &scene_.shapes;
  if (lights)
    unseen_.emplace_back(scene_.shapes.size(), object.place);
  else
    reader_.notes.dropped("an object with no_image", reader_.location(object.place));
  return lights;
}

void SceneMaker::hide_lamps() {
  if (unseen_.empty() && sees_around_) return;
  const bool sees_around = sees_around_ && (world_.background || world_.sky);
  if (!sees_glow_ && !sees_around) return void(scene_.settings.hides_emitters = true);
  for (auto shape = unseen_.rbegin(); shape != unseen_.rend(); ++shape) {
    scene_.shapes.erase(scene_.shapes.begin() + static_cast<std::ptrdiff_t>(shape->first));
    reader_.notes.dropped("an object with no_image", reader_.location(shape->second));
  }
}

}  // namespace vitrail::pov
