// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/old_versions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace vitrail::mitsuba {

namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

void rename_properties(Object& object) {
  // Names of version 0.3.
  const bool had_intensity = object.tag == "emitter" && object.type != "point" && object.type != "spot";
  for (Property& p : object.properties) {
    if (object.type == "diffuse" && p.name == "diffuse_reflectance") p.name = "reflectance";
    if (had_intensity && p.name == "intensity")
      p.name = object.type == "directional" ? "irradiance" : "radiance";
  }
}

// Properties for what a plugin of the same name does otherwise today.
void mark_old_meanings(Object& object) {
  const auto mark = [&](const char* name) { object.properties.push_back({name, true, object.origin}); };
  const std::string& type = object.type;
  // Where models of daylight have their zenith; +z since version 3.
  if (object.tag == "emitter" && (type == "sky" || type == "sun" || type == "sunsky")) mark("y_is_up");
  if (object.tag == "shape" && type == "ply") mark("colors_in_srgb");
  if (object.tag == "shape" && type != "shapegroup" && type != "instance") mark("media_have_no_surface");
  if (object.tag == "texture" && type == "bitmap") mark("gamma_of_file");
}

// uscale … voffset become a to_uv.
void join_uv_transform(Object& object) {
  Vector3d size{1, 1, 1}, offset;
  const std::array<std::pair<std::string_view, double*>, 4> parts{
      {{"uscale", &size.x}, {"vscale", &size.y}, {"uoffset", &offset.x}, {"voffset", &offset.y}}};
  std::optional<Origin> place;
  for (const Property& p : object.properties) {
    const auto target = std::ranges::find(parts, p.name, [](const auto& part) { return part.first; });
    const auto* const number = std::get_if<double>(&p.value);
    if (target == parts.end() || !number) continue;
    *target->second = *number;
    p.queried = true;
    place = p.origin;
  }
  if (place) object.properties.push_back({"to_uv", translate(offset) * scale(size), *place});
}

// How often 0.6's "direct" looks at each light changes nothing; since version 2 it does (light_samples.h).
void leave_out_light_samples(Object& object) {
  if (object.tag == "integrator")
    std::erase_if(object.properties, [](const Property& p) {
      return p.name == "emitter_samples" || p.name == "luminaire_samples" || p.name == "shading_samples";
    });
}

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
  rename_properties(object);
  mark_old_meanings(object);
  join_uv_transform(object);
  leave_out_light_samples(object);
}

}  // namespace vitrail::mitsuba
