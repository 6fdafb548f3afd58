// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/collada_cameras.h"

#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <string>

#include "importers/bytes/input_bytes.h"
#include "importers/reading/guarded_xml.h"
#include "importers/reading/xml_nesting.h"

namespace vitrail::assimp {

namespace {

constexpr double to_rad = std::numbers::pi / 180;

double number(pugi::xml_node parent, const char* name) {
  const double value = parent.child(name).text().as_double(0);
  return std::isfinite(value) && value > 0 ? value : 0;
}

AssetCamera camera_of(pugi::xml_node optics) {
  AssetCamera camera;
  const pugi::xml_node common = optics.child("technique_common");
  if (const pugi::xml_node o = common.child("orthographic")) {
    const double aspect = number(o, "aspect_ratio");
    camera.half_width = number(o, "xmag"), camera.half_height = number(o, "ymag");
    if (camera.half_width == 0 && aspect > 0) camera.half_width = camera.half_height * aspect;
    if (camera.half_height == 0 && aspect > 0) camera.half_height = camera.half_width / aspect;
    if (camera.half_width > 0 && camera.half_height > 0)
      camera.aspect = camera.half_width / camera.half_height;
    return camera;
  }
  const pugi::xml_node p = common.child("perspective");
  camera.horizontal_fov_deg = number(p, "xfov"), camera.vertical_fov_deg = number(p, "yfov");
  camera.aspect = number(p, "aspect_ratio");
  if (camera.aspect == 0 && camera.horizontal_fov_deg > 0 && camera.vertical_fov_deg > 0)
    camera.aspect =
        std::tan(camera.horizontal_fov_deg * to_rad / 2) / std::tan(camera.vertical_fov_deg * to_rad / 2);
  return camera;
}

void collect(pugi::xml_node parent, const std::map<std::string, AssetCamera>& known,
             std::vector<AssetCamera>& cameras) {
  for (const pugi::xml_node instance : parent.children("instance_camera")) {
    const std::string url = instance.attribute("url").value();
    if (const auto camera = known.find(url.substr(url.starts_with('#') ? 1 : 0)); camera != known.end())
      cameras.push_back(camera->second);
  }
  for (const pugi::xml_node node : parent.children("node")) collect(node, known, cameras);
}

}  // namespace

std::vector<AssetCamera> collada_cameras(const std::filesystem::path& file) {
  const InputBytes bytes(file);
  guard_xml();
  pugi::xml_document document;
  if (!document.load_buffer(bytes.begin(), bytes.size()) || too_deep_element(document)) return {};
  const pugi::xml_node root = document.document_element();
  std::map<std::string, AssetCamera> known;
  for (const pugi::xml_node library : root.children("library_cameras"))
    for (const pugi::xml_node camera : library.children("camera"))
      known.emplace(camera.attribute("id").value(), camera_of(camera.child("optics")));
  const std::string shown = root.child("scene").child("instance_visual_scene").attribute("url").value();
  std::vector<AssetCamera> cameras;
  for (const pugi::xml_node library : root.children("library_visual_scenes"))
    for (const pugi::xml_node scene : library.children("visual_scene"))
      if (shown == std::string("#") + scene.attribute("id").value()) collect(scene, known, cameras);
  return cameras;
}

}  // namespace vitrail::assimp
