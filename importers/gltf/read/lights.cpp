// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/gltf/read/extension_values.h"
#include "importers/gltf/units.h"

namespace vitrail::gltf {

namespace {

// Without scales: unit axes at the same place.
Transform without_scale(const Transform& t) {
  Transform unit_axes = t;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3d axis = normalize(Vector3d{t.m[0][c], t.m[1][c], t.m[2][c]});
    unit_axes.m[0][c] = axis.x, unit_axes.m[1][c] = axis.y, unit_axes.m[2][c] = axis.z;
  }
  return unit_axes;
}

}  // namespace

void add_light(const Document& document, int node_index, const Transform& to_world, ImportedScene& imported) {
  const tinygltf::Model& model = document.model();
  const auto& node = model.nodes[static_cast<std::size_t>(node_index)];
  const tinygltf::Value* reference = extension(node.extensions, "KHR_lights_punctual");
  if (!reference) return;
  const auto& light =
      document.element(model.lights, index(*reference, "light"), "lights", "nodes", node_index);
  const SourceLocation place = document.place("nodes", node_index);
  const auto note = [&](Fidelity fidelity, std::string what) {
    imported.diagnostics.push_back({fidelity, std::move(what), place, place, RecordKind::light});
  };
  RGB color{1, 1, 1};
  if (light.color.size() == 3) color = {light.color[0], light.color[1], light.color[2]};
  if (std::min({color.r, color.g, color.b, light.intensity}) < 0) {
    note(Fidelity::dropped, "a light of negative colour or intensity");
    return;
  }
  if (light.range > 0)
    note(Fidelity::approximated, fmt::format("its range of {:g} ends nothing: light goes on", light.range));
  const Transform frame = without_scale(to_world);
  const Spectrum spectrum = emission(color, light.intensity);
  Light out;
  out.origin = document.origin("nodes", node_index);
  if (light.type == "directional") {
    out.model = DistantLight{unit(transform_vector(frame, {0, 0, -1})), spectrum};
  } else if (light.type == "point") {
    out.model = PointLight{transform_point(frame, {0, 0, 0}), spectrum};
  } else if (light.type == "spot") {
    constexpr double degrees = 180 / std::numbers::pi;
    const double outer = std::clamp(light.spot.outerConeAngle * degrees, 0.01, 90.0);
    const double inner = std::clamp(light.spot.innerConeAngle * degrees, 0.0, outer);
    out.model = SpotLight{frame * scale({1, -1, -1}),     spectrum,
                          static_cast<float>(inner),      static_cast<float>(outer),
                          SpotLight::Falloff::smoothstep, {}};
    note(Fidelity::approximated, "between its cones a spot falls off by smoothstep");
  } else {
    note(Fidelity::dropped, fmt::format("a light of the kind \"{}\"", light.type));
    return;
  }
  imported.scene.lights.push_back(std::move(out));
}

void take_camera(const Document& document, int node_index, const Transform& to_world,
                 ImportedScene& imported) {
  constexpr int longer_side = 1280;
  const tinygltf::Model& model = document.model();
  const int camera_index = model.nodes[static_cast<std::size_t>(node_index)].camera;
  const auto& camera = document.element(model.cameras, camera_index, "cameras", "nodes", node_index);
  const bool orthographic = camera.type == "orthographic";
  const auto& o = camera.orthographic;
  const auto& p = camera.perspective;
  Scene& scene = imported.scene;
  FilmSettings& film = scene.film;
  double aspect = orthographic ? std::abs(o.xmag / o.ymag) : p.aspectRatio;
  if (!(aspect > 1e-3 && aspect < 1e3)) aspect = static_cast<double>(film.width) / film.height;
  film.width = aspect >= 1 ? longer_side : std::max(1, static_cast<int>(std::lround(longer_side * aspect)));
  film.height = aspect >= 1 ? std::max(1, static_cast<int>(std::lround(longer_side / aspect))) : longer_side;
  film.crop = {0, film.width, 0, film.height};
  const double half = orthographic ? std::abs(o.ymag) : std::tan(p.yfov / 2);
  if (!(half > 0 && std::isfinite(half)) || (!orthographic && p.yfov >= std::numbers::pi))
    document.fail("cameras", camera_index,
                  orthographic ? "its ymag is no width" : "its yfov is no angle below π");
  const double wide = half * film.width / film.height;
  // It looks along −z.
  const Transform frame = without_scale(to_world) * scale({1, 1, -1});
  if (!is_invertible(frame)) document.fail("nodes", node_index, "a camera without a direction");
  const ScreenWindow screen{-wide, wide, -half, half};
  if (orthographic)
    scene.camera = OrthographicCamera{frame, screen, {}};
  else
    scene.camera = PerspectiveCamera{frame, screen, {}};
  scene.camera_origin = document.origin("nodes", node_index);
}

}  // namespace vitrail::gltf
