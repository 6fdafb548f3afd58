// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/area_lamp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

// The lights stand in the middles of equal cells: the area reaches half a cell beyond the outer ones.
Vector3d whole(Vector3d axis, int count) { return axis * (count / (count - 1.0)); }

bool coincides(const AreaLamp& lamp, const std::vector<Point3f>& positions, const Transform& to_world) {
  const double near = 1e-3 * length(lamp.corners[2] - lamp.corners[0]);
  return positions.size() == 4 && std::ranges::all_of(lamp.corners, [&](Point3d corner) {
           return std::ranges::any_of(positions, [&](Point3f p) {
             return length(transform_point(to_world, cast<double>(p)) - corner) < near;
           });
         });
}

}  // namespace

std::optional<AreaLamp> area_lamp(const LightShape& light, const Transform& to_world) {
  if (!light.area || light.shadowless || light.circular || light.count1 < 2 || light.count2 < 2) return {};
  const bool by_cosine = light.kind == LightShape::Kind::spot && light.radius_deg >= 90 &&
                         light.falloff_deg >= 90 && light.tightness == 1;
  if (!by_cosine || light.fade_power != 2 || !(light.fade_distance > 0)) return {};
  const Vector3d u = transform_vector(to_world, whole(light.axis1, light.count1)),
                 v = transform_vector(to_world, whole(light.axis2, light.count2));
  const Point3d at = transform_point(to_world, light.position);
  const Vector3d axis = transform_point(to_world, light.point_at) - at, normal = cross(u, v);
  const double area = length(normal), side = std::min(length(u), length(v));
  if (!(area > 0) || !(std::abs(dot(axis, normal)) > 0.9999 * area * length(axis))) return {};
  if (!(light.fade_distance < 0.01 * side)) return {};
  AreaLamp lamp;
  lamp.corners = {at - u * 0.5 - v * 0.5, at + u * 0.5 - v * 0.5, at + u * 0.5 + v * 0.5,
                  at - u * 0.5 + v * 0.5};
  if (dot(axis, normal) < 0) std::swap(lamp.corners[1], lamp.corners[3]);
  lamp.color = {light.color.v[0], light.color.v[1], light.color.v[2]};
  lamp.factor = 2 * std::numbers::pi * light.fade_distance * light.fade_distance / area;
  return lamp;
}

// A mesh that glows where a lamp is, is what shows the lamp: the two become one. Of two lamps back to back it
// shows both. Else nothing is seen of a lamp.
void SceneMaker::add_lamps() {
  const std::size_t first = scene_.area_lights.size();
  for (const AreaLamp& lamp : lamps_) {
    const auto channel = [&](std::size_t i) {
      return std::max(0.0, reader_.linear(lamp.color[i]) * lamp.factor);
    };
    const auto seen = std::ranges::find_if(scene_.shapes, [&](const Shape& shape) {
      return shape.area_light && !shape.interior && !shape.exterior &&
             coincides(lamp, scene_.meshes[shape.mesh.value].positions, shape.object_to_world) &&
             (shape.area_light->value >= first || !scene_.area_lights[shape.area_light->value].sampled);
    });
    if (seen != scene_.shapes.end() && seen->area_light->value >= first) {
      scene_.area_lights[seen->area_light->value].two_sided = true;
      continue;
    }
    AreaLight light;
    light.radiance = emission_from_rgb({channel(0), channel(1), channel(2)});
    light.origin = origin(lamp.place);
    const Id<AreaLight> id{static_cast<std::uint32_t>(scene_.area_lights.size())};
    scene_.area_lights.push_back(std::move(light));
    TriangleMesh mesh;
    for (const Point3d& corner : lamp.corners) mesh.positions.push_back(cast<float>(corner));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const bool unseen = seen == scene_.shapes.end();
    if (unseen) {
      scene_.materials.push_back({.model = DiffuseMaterial{Spectrum{ConstantSpectrum{0}}}});
      scene_.shapes.emplace_back();
      scene_.shapes.back().material = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
      scene_.shapes.back().opacity = 0.0f;
      scene_.shapes.back().origin = origin(lamp.place);
    }
    Shape& shape = unseen ? scene_.shapes.back() : *seen;
    shape.mesh = add_mesh(std::move(mesh));
    shape.object_to_world = {};
    shape.flip_orientation = false;
    shape.area_light = id;
  }
}

}  // namespace vitrail::pov
