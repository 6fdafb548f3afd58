// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/scene_parts.h"

#include <fmt/format.h>

#include "bundle/binary_records.h"
#include "bundle/checksum.h"
#include "bundle/manifest_json.h"
#include "scene/records/kinds.h"

namespace vitrail {

namespace {

using Ordered = nlohmann::ordered_json;

std::string fingerprint(const std::string& text) {
  return fmt::format("checksum {:016x}", checksum(std::as_bytes(std::span(text))));
}

std::string words(const auto& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

std::string place_of_camera(const Manifest& m) {
  const Transform to_world =
      translate(m.offset) * std::visit([](const auto& c) { return c.camera_to_world; }, m.camera);
  return fmt::format("{} at {} along {}, up {}", kind_of(m.camera),
                     words(transform_point(to_world, Point3d{0, 0, 0})),
                     words(transform_vector(to_world, Vector3d{0, 0, 1})),
                     words(transform_vector(to_world, Vector3d{0, 1, 0})));
}

// All but where it stands: the window that it sees through, its lens.
std::string view_of_camera(const Manifest& m) {
  constexpr std::size_t readable = 200;
  Json view = camera_to_json(m.camera);
  view.erase("camera_to_world"), view.erase("kind");
  const std::string text = view.dump();
  return text.size() > readable ? fingerprint(text) : text;
}

std::string shapes_of(const Manifest& m) {
  const Bounds3f& b = m.bounds;
  return fmt::format("{} triangles and quadrics from ({:.9g}, {:.9g}, {:.9g}) to ({:.9g}, {:.9g}, {:.9g})",
                     m.triangles, b.lower[0] + m.offset.x, b.lower[1] + m.offset.y, b.lower[2] + m.offset.z,
                     b.upper[0] + m.offset.x, b.upper[1] + m.offset.y, b.upper[2] + m.offset.z);
}

std::string records_in(const std::filesystem::path& file, std::size_t count) {
  return fmt::format("{}, checksum {:016x}", count, checksum_of_records(file));
}

std::string images_of(const Manifest& m) {
  std::string hashes;
  for (const TextureFileEntry& t : m.texture_files) hashes += fmt::format("{:x} ", t.hash);
  return m.texture_files.empty() ? "none"
                                 : fmt::format("{}, {}", m.texture_files.size(), fingerprint(hashes));
}

std::string value_of(const Ordered& about, const std::string& name) {
  if (!about.is_object()) return {};
  const auto found = about.find(name);
  if (found == about.end()) return {};
  return found->is_string() ? found->get<std::string>() : fingerprint(found->dump());
}

}  // namespace

Ordered scene_parts(const Manifest& m, const std::filesystem::path& bundle) {
  Ordered parts{{"camera", place_of_camera(m)}, {"view of the camera", view_of_camera(m)}};
  if (m.requirements.motion) parts["motion"] = fingerprint(motions_to_json(m).dump());
  parts["filter"] = film_to_json(m.film).at("filter").dump();
  parts["materials and textures"] = records_in(bundle / "materials.bin", m.materials.size());
  parts["images"] = images_of(m);
  parts["lights"] = records_in(bundle / "lights.bin", m.lights.size() + m.area_lights.size());
  parts["shapes"] = shapes_of(m);
  return parts;
}

std::string differences_of_scenes(const std::string& about, const std::string& asked_for) {
  const Ordered held = Ordered::parse(about, nullptr, false),
                asked = Ordered::parse(asked_for, nullptr, false);
  std::string text;
  const auto compare = [&](const Ordered& mine, const Ordered& theirs, const std::string& key,
                           const std::string& name, const char* where_not_told = "none") {
    const std::string x = value_of(mine, key), y = value_of(theirs, key);
    if (x != y)
      text += fmt::format("{}{}: {}, this command has {}", text.empty() ? "" : "; ", name,
                          x.empty() ? where_not_told : x, y.empty() ? where_not_told : y);
    return x != y;
  };
  compare(held, asked, "glazing", "values of --set", "nothing");
  const bool sampled_otherwise = compare(held, asked, "sampling", "way to sample", "as usual");
  compare(held, asked, "sensors", "sensors");
  const Ordered none = Ordered::object();
  const Ordered& parts = held.is_object() && held.contains("parts") ? held["parts"] : none;
  if (parts.empty()) return text.empty() ? "scene: another" : text;
  for (const auto& [name, value] : asked["parts"].items())
    if (!(name == "filter" && sampled_otherwise)) compare(parts, asked["parts"], name, name);
  return text.empty() ? "shapes: as many and as far apart, but others" : text;
}

}  // namespace vitrail
