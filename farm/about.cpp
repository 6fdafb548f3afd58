// SPDX-License-Identifier: Apache-2.0
#include "farm/about.h"

#include <nlohmann/json.hpp>

#include "scene/kinds.h"

namespace vitrail {

std::string about(const Manifest& m, const RenderOptions& options) {
  using Json = nlohmann::ordered_json;
  const Transform camera_to_bundle =
      std::visit([](const auto& camera) { return camera.camera_to_world; }, m.camera);
  const Transform world_to_camera = inverse(translate(m.offset) * camera_to_bundle);
  Json numbers = Json::array();
  for (const auto& row : world_to_camera.m)
    for (const double value : row) numbers.push_back(value);
  const Json about{
      {"scene", options.scene_name}, {"camera", kind_of(m.camera)}, {"world_to_camera", numbers}};
  return about.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vitrail
