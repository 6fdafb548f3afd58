// SPDX-License-Identifier: Apache-2.0
// What the parts of the Mitsuba writer share: the state of one document, and elements with exact numbers.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "importers/mesh_files.h"
#include "scene/color.h"
#include "scene/scene.h"
#include "scene/transmission.h"

namespace vitrail::mitsuba_writer {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

// A texture as Mitsuba can say it: an element of its own, by id, or one value for all of the surface.
using WrittenTexture = std::variant<std::string, Spectrum>;

struct Context {
  Context(const Scene& scene_to_write, const std::filesystem::path& out)
      : scene(scene_to_write),
        file(out),
        meshes(scene_to_write, out),
        side_files(out),
        transmitting(vitrail::transmitting(scene_to_write.materials)),
        sided(with_sides(scene_to_write.materials)) {}

  const Scene& scene;
  std::filesystem::path file;  // of the scene
  MeshFiles meshes;
  SideFiles side_files;
  std::vector<bool> transmitting;  // Mitsuba allows no `twosided` around such materials
  std::vector<bool> sided;         // with_sides
  Diagnostics diagnostics;
  Origin origin;  // of the record that is being written

  std::unordered_set<std::string> taken_ids;  // Mitsuba has one name space for everything
  std::vector<std::string> material_ids, medium_ids, prototype_ids;
  std::vector<WrittenTexture> textures;
  mutable std::unordered_map<std::uint32_t, RGB> means;  // of the textures whose mean was asked for
  std::unordered_map<std::size_t, std::string>
      interiors;  // media inside of subsurface materials, by material
  std::size_t derived_meshes = 0, derived_images = 0, derived_volumes = 0;

  void approximated(std::string message) { report(Fidelity::approximated, std::move(message)); }
  void dropped(std::string message) { report(Fidelity::dropped, std::move(message)); }

  // An id for a record called `name`; a record without a name gets one that starts with "_unnamed_".
  std::string new_id(const std::string& name, const char* kind, std::size_t index);
  // A file as the scene refers to it.
  std::string relative(const std::string& other);
  // The path of a new file in OUT-`kind`/, which is created; relative to the scene's.
  std::string new_file(const char* kind, const char* extension, std::size_t& counter) const;

 private:
  void report(Fidelity fidelity, std::string message);
};

using Element = pugi::xml_node;

Element add(Element parent, const char* tag, const std::string& type, const std::string& name = "",
            const std::string& id = "");
void add_value(Element parent, const char* tag, const std::string& name, const std::string& value);
void add_string(Element parent, const std::string& name, const std::string& value);
void add_integer(Element parent, const std::string& name, int value);
void add_boolean(Element parent, const std::string& name, bool value);
// The fewest digits that give the same bits back. What is not finite becomes the nearest number, NaN zero.
template <class T>
void add_float(Element parent, const std::string& name, T value) {
  constexpr T largest = static_cast<T>(std::numeric_limits<float>::max());
  add_value(parent, "float", name,
            fmt::format("{}", value == value ? std::clamp(value, -largest, largest) : T(0)));
}
void add_reference(Element parent, const std::string& id, const std::string& name = "");
void add_transform(Element parent, const Transform& transform, const std::string& name = "to_world");
// The vector's or point's three coordinates as attributes.
template <class T>
void add_coordinates(Element parent, const char* tag, const std::string& name, const T& v) {
  Element element = parent.append_child(tag);
  element.append_attribute("name") = name.c_str();
  element.append_attribute("x") = fmt::format("{}", v.x).c_str();
  element.append_attribute("y") = fmt::format("{}", v.y).c_str();
  element.append_attribute("z") = fmt::format("{}", v.z).c_str();
}

}  // namespace vitrail::mitsuba_writer
