// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/light/media_scenes.h"

#include <algorithm>
#include <cmath>

namespace vitrail::test {

std::vector<MediumPlace> places(Point3d lamp, bool round) {
  const auto place = [&](const char* name, Point3d center, double reach, double sigma_a) {
    return MediumPlace{std::string(name) + (round ? ", a ball" : ", a cube"), center, reach, round, sigma_a};
  };
  return {place("around the light", lamp, 1, 0.5), place("before the light", {0, 0, lamp.z / 2}, 0.6, 0.5),
          place("across the light", lamp + Vector3d{1, 0, 0}, 1.05, 0.5),
          place("around the spot", {0, 0, 0}, 1, 0.5), place("around everything", {0, 0, 0}, 40, 0.05)};
}

MediumPlace endless(double sigma_a) { return {"without end", {}, 0, false, sigma_a}; }

double through(const MediumPlace& place, Point3d a, Point3d b) {
  const Vector3d way = b - a, from = a - place.center;
  double t0 = 0, t1 = 1;
  if (place.round) {
    // |from + t·way| = reach
    const double p = dot(from, way) / dot(way, way);
    const double q = (dot(from, from) - place.reach * place.reach) / dot(way, way), root2 = p * p - q;
    if (root2 <= 0) return 1;
    t0 = std::max(t0, -p - std::sqrt(root2)), t1 = std::min(t1, -p + std::sqrt(root2));
  } else if (!place.is_endless()) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = (-place.reach - from[axis]) / way[axis], y = (place.reach - from[axis]) / way[axis];
      if (way[axis] == 0 && std::abs(from[axis]) > place.reach) return 1;
      if (way[axis] != 0) t0 = std::max(t0, std::min(x, y)), t1 = std::min(t1, std::max(x, y));
    }
  }
  return t1 > t0 ? std::exp(-place.sigma_a * (t1 - t0) * length(way)) : 1;
}

Medium absorbing(double sigma_a, bool grid) {
  Medium m;
  m.coefficients = AbsorptionScattering{ConstantSpectrum{static_cast<float>(sigma_a)}, ConstantSpectrum{0}};
  if (grid) {
    Grid cell;
    cell.nx = cell.ny = cell.nz = 1, cell.values = {1};
    cell.bounds = {{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}};
    m.density = cell;
  }
  return m;
}

void fill(Scene& scene, const MediumPlace& place, bool grid, const Material& boundary) {
  scene.media.push_back(absorbing(place.sigma_a, grid));
  if (place.is_endless() || place.reach > 20) scene.camera_medium = Id<Medium>{0};
  if (place.is_endless()) return;
  if (place.round) {
    add_quadric(scene, {}, ball(place.center, place.reach), boundary);
  } else {
    const Vector3d corner{place.reach, place.reach, place.reach};
    add_shape(
        scene,
        add_quads(scene, box_faces(cast<float>(place.center - corner), cast<float>(place.center + corner))),
        boundary);
  }
  scene.shapes.back().interior = Id<Medium>{0};
}

Transform ball(Point3d center, double radius) {
  return translate(center - Point3d{}) * scale({radius, radius, radius});
}

void add_quadric(Scene& scene, const Quadric& quadric, const Transform& to, const Material& material,
                 const std::optional<AreaLight>& light) {
  scene.meshes.emplace_back().quadric = quadric;
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, material, light);
  scene.shapes.back().object_to_world = to;
}

}  // namespace vitrail::test
