// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/old_versions.h"

#include <cctype>

namespace vitrail::mitsuba {

namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

}  // namespace

std::string name_of_today(const std::string& name) {
  std::string result;
  bool in_run = false;
  for (const char c : name) {
    if (!is_upper(c)) in_run = false;
    if (is_upper(c) && !in_run && !result.empty() && is_lower(result.back())) {
      result += '_';
      in_run = true;
    }
    result += in_run ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : c;
  }
  return result;
}

std::string tag_of_today(const std::string& tag) {
  if (tag == "luminaire") return "emitter";
  if (tag == "camera") return "sensor";
  return tag;
}

bool is_color_of_old_file(std::string_view value, const Object& owner) {
  const bool has_wavelengths = value.find(':') != std::string_view::npos;
  const std::size_t first = value.find_first_not_of(" ,\t\n\r");
  if (has_wavelengths || first == std::string_view::npos) return false;
  const std::size_t end = value.find_first_of(" ,\t\n\r", first);
  const bool is_list = value.find_first_not_of(" ,\t\n\r", end) != std::string_view::npos;
  return is_list || owner.tag == "emitter";
}

void upgrade(Object& object) {
  Vector3d size{1, 1, 1}, offset;
  bool moved = false;
  Origin place;
  for (Property& p : object.properties) {
    if (object.type == "diffuse" && p.name == "diffuse_reflectance") p.name = "reflectance";
    const bool plain = std::holds_alternative<double>(p.value);
    double* target = !plain                ? nullptr
                     : p.name == "uscale"  ? &size.x
                     : p.name == "vscale"  ? &size.y
                     : p.name == "uoffset" ? &offset.x
                     : p.name == "voffset" ? &offset.y
                                           : nullptr;
    if (!target) continue;
    *target = std::get<double>(p.value);
    moved = p.queried = true;
    place = p.origin;
  }
  // Names of version 0.3.
  if (object.tag == "emitter" && object.type != "point" && object.type != "spot")
    for (Property& p : object.properties)
      if (p.name == "intensity") p.name = object.type == "directional" ? "irradiance" : "radiance";
  // Where its models of daylight have their zenith; +z since version 3.
  const bool daylight = object.type == "sky" || object.type == "sun" || object.type == "sunsky";
  if (daylight && object.tag == "emitter") object.properties.push_back({"y_is_up", true, object.origin});
  if (object.tag == "shape" && object.type == "ply")
    object.properties.push_back({"colors_in_srgb", true, object.origin});
  if (object.tag == "texture" && object.type == "bitmap")
    object.properties.push_back({"gamma_of_file", true, object.origin});
  if (moved) object.properties.push_back({"to_uv", translate(offset) * scale(size), place});
}

}  // namespace vitrail::mitsuba
