// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/about.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "bundle/matte_names.h"
#include "farm/plan/scene_parts.h"
#include "scene/records/kinds.h"
#include "tracer/view/pixel_filter.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

// From a camera's space to where x and y go from −1 to 1 over the picture, right and up, and z from 0, 0.01
// before the camera, to 1, infinitely far.
std::optional<Transform> to_ndc(const Camera& camera) {
  const auto over = [](const ScreenWindow& s, std::size_t centre_column) {
    const double dx = s.x1 - s.x0, dy = s.y1 - s.y0;
    Transform t;
    t.m = {};
    t.m[0][0] = 2 / dx, t.m[0][centre_column] = -(s.x0 + s.x1) / dx;
    t.m[1][1] = 2 / dy, t.m[1][centre_column] = -(s.y0 + s.y1) / dy;
    t.m[2] = {0, 0, 1, centre_column == 2 ? -0.01 : 0};
    t.m[3][centre_column] = 1;
    return t;
  };
  if (const auto* c = std::get_if<PerspectiveCamera>(&camera)) return over(c->screen, 2);
  if (const auto* c = std::get_if<OrthographicCamera>(&camera)) return over(c->screen, 3);
  return std::nullopt;
}

Json numbers_of(const Transform& t) {
  Json numbers = Json::array();
  for (const auto& row : t.m)
    for (const double value : row) numbers.push_back(value);
  return numbers;
}

}  // namespace

std::string about(const Manifest& m, const RenderOptions& options) {
  const Transform camera_to_bundle =
      std::visit([](const auto& camera) { return camera.camera_to_world; }, m.camera);
  const Transform world_to_camera = inverse(translate(m.offset) * camera_to_bundle);
  Json about{{"scene", options.outputs.scene_name},
             {"camera", kind_of(m.camera)},
             {"world_to_camera", numbers_of(world_to_camera)},
             {"parts", scene_parts(m, options.bundle)}};
  if (!options.picture.glazing.empty()) about["glazing"] = options.picture.glazing;
  if (const std::string sampling = words_of(options.picture.samples); !sampling.empty())
    about["sampling"] = sampling;
  if (const FilterSampler filter(m.film.filter, options.picture.samples.sampling.splat); filter.splats()) {
    const Neighbours n = filter.neighbours();
    about["neighbours"] = {n.of_mean, n.of_variances};
  }
  if (const auto* sensors = std::get_if<SensorCamera>(&m.camera))
    for (const Sensor& s : sensors->sensors) {
      const Point3d p = transform_point(translate(m.offset) * camera_to_bundle, s.position);
      const Vector3d n = transform_vector(camera_to_bundle, s.normal);
      about["sensors"].push_back({p.x, p.y, p.z, n.x, n.y, n.z});
    }
  if (m.film.layers.has(Layer::crypto_object))
    about["mattes"]["crypto_object"] = read_shape_names(options.bundle, m);
  if (m.film.layers.has(Layer::crypto_material)) about["mattes"]["crypto_material"] = material_names(m);
  if (const auto ndc = to_ndc(m.camera)) about["world_to_ndc"] = numbers_of(*ndc * world_to_camera);
  return about.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vitrail
