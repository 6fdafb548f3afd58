// SPDX-License-Identifier: Apache-2.0
// The directives of lights, and the light of a shape.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/pbrt/read/directives.h"
#include "importers/pbrt/read/image_power.h"

namespace vitrail::pbrt {

void Interpreter::light_source(const Place& place) {
  const std::string kind = read_text("a kind of light");
  ParameterSet parameters = read_set("LightSource", kind, place, "light");
  report_held("a light", place);
  if (auto light = make_light(kind, parameters, state_.ctm, scope(place)))
    scene_.lights.push_back(std::move(*light));
}

void Interpreter::area_light_source(const Place& place) {
  const std::string kind = read_text("a kind of light");
  ParameterSet parameters = read_set("AreaLightSource", kind, place, "light");
  state_.area_light = std::make_shared<AreaLightState>(
      AreaLightState{make_area_emission(kind, parameters, scope(place)), std::nullopt});
}

// The area in the world of each of the shapes that pbrt makes of a mesh, which all emit the whole power.
double Interpreter::area_per_part(const ShapeGeometry& geometry, const Place& place) {
  TriangleMesh storage;
  const TriangleMesh& stored = scene_.meshes[geometry.mesh.value];
  if (stored.quadric && !geometry.curve)
    return area_of(*stored.quadric, state_.ctm * geometry.mesh_to_object);
  const TriangleMesh& mesh = loaded(stored, storage);
  double total = 0, least = INFINITY, greatest = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      return transform_point(state_.ctm, cast<double>(mesh.positions[triangle[i]]));
    };
    const double area = length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    total += area;
    least = std::min(least, area);
    greatest = std::max(greatest, area);
  }
  constexpr double tolerance = 1.001;
  if (geometry.parts > 1 && greatest > least * tolerance)
    context_.report.approximated("the power of an area light: all of the mesh gets the mean radiance", place);
  return total / static_cast<double>(geometry.parts);
}

std::optional<double> Interpreter::mean_of_image(Id<Texture> texture) {
  const auto [known, is_new] = image_means_.try_emplace(texture.value);
  if (is_new) known->second = mean_luminance(std::get<ImageTexture>(scene_.textures.at(texture.value).model));
  return known->second;
}

std::optional<Id<AreaLight>> Interpreter::shape_light(const ShapeGeometry& geometry, const Place& place) {
  if (!state_.area_light) return std::nullopt;
  if (current_object_) {
    context_.report.dropped("area lights of objects that are instanced do not shine, as in pbrt", place);
    return std::nullopt;
  }
  if (placing(place).motion) {
    context_.report.dropped("area lights that move do not shine: as in pbrt-v3, and v4 refuses them", place);
    return std::nullopt;
  }
  AreaLightState& state = *state_.area_light;
  if (state.id && !(state.emission.power > 0)) return state.id;
  AreaLight light = state.emission.light;
  if (state.emission.power > 0) {
    const double area = area_per_part(geometry, place) * (light.two_sided ? 2 : 1);
    if (!(area > 0)) fail("an area light with a power needs a shape with an area", place);
    const double factor = state.emission.power / (area * std::numbers::pi);
    if (const auto* radiance = std::get_if<Spectrum>(&light.radiance))
      light.radiance = scaled(*radiance, factor);
    else if (const auto mean = mean_of_image(std::get<Id<Texture>>(light.radiance)))
      light.scale = static_cast<float>(static_cast<double>(light.scale) * factor / *mean);
    else
      context_.report.approximated(
          "the power of an area light whose image is black or cannot be read: the image counts by its scale",
          place);
  }
  // An equal one that came not long ago is shared.
  constexpr std::size_t looked_back = 16;
  const std::size_t count = scene_.area_lights.size();
  for (std::size_t i = count; i-- > count - std::min(count, looked_back);)
    if (scene_.area_lights[i] == light) return state.id = Id<AreaLight>{static_cast<std::uint32_t>(i)};
  state.id = Id<AreaLight>{static_cast<std::uint32_t>(count)};
  scene_.area_lights.push_back(std::move(light));
  area_light_places_.push_back(state.emission.place);
  return state.id;
}

}  // namespace vitrail::pbrt
