// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_context.h"

namespace vitrail::mitsuba_writer {

TextureRoles::TextureRoles(const Scene& scene)
    : height(scene.textures.size()), normal_map(scene.textures.size()) {
  for (const Material& material : scene.materials) {
    if (material.normal_map) normal_map.at(material.normal_map->value) = true;
    if (!material.displacement) continue;
    if (const auto* id = std::get_if<Id<Texture>>(&*material.displacement)) height.at(id->value) = true;
  }
}

std::string Context::new_id(const std::string& name, const char* kind, std::size_t index) {
  const bool substitutable = name.find('$') != std::string::npos;  // Mitsuba would look for a parameter
  std::string id = name.empty() || substitutable ? fmt::format("_unnamed_{}_{}", kind, index) : name;
  if (substitutable)
    approximated(fmt::format("the name \"{}\" is written as \"{}\": $ starts a parameter", name, id));
  std::string unique = ids.take(id);
  if (unique != id && !name.empty())
    approximated(
        fmt::format("the name \"{}\" is written as \"{}\": another record has it already", name, unique));
  return unique;
}

std::string Context::relative(const std::string& other) {
  std::string name = relative_name(other, file.parent_path());
  if (name.find('$') != std::string::npos)
    dropped(fmt::format("{}: Mitsuba takes $ for the start of a parameter: rename the file", name));
  return name;
}

std::string Context::new_file(const char* kind, const char* extension, std::size_t& counter) const {
  return side_files.name(kind, counter++, extension);
}

Element add(Element parent, const char* tag, const std::string& type, const std::string& name,
            const std::string& id) {
  Element element = parent.append_child(tag);
  element.append_attribute("type") = type.c_str();
  if (!name.empty()) element.append_attribute("name") = name.c_str();
  if (!id.empty()) element.append_attribute("id") = id.c_str();
  return element;
}

void add_value(Element parent, const char* tag, const std::string& name, const std::string& value) {
  Element element = parent.append_child(tag);
  if (!name.empty()) element.append_attribute("name") = name.c_str();
  element.append_attribute("value") = value.c_str();
}

void add_string(Element parent, const std::string& name, const std::string& value) {
  add_value(parent, "string", name, value);
}

void add_integer(Element parent, const std::string& name, int value) {
  add_value(parent, "integer", name, fmt::format("{}", value));
}

void add_boolean(Element parent, const std::string& name, bool value) {
  add_value(parent, "boolean", name, value ? "true" : "false");
}

void add_reference(Element parent, const std::string& id, const std::string& name) {
  Element element = parent.append_child("ref");
  if (!name.empty()) element.append_attribute("name") = name.c_str();
  element.append_attribute("id") = id.c_str();
}

void add_transform(Element parent, const Transform& transform, const std::string& name) {
  Element element = parent.append_child("transform");
  element.append_attribute("name") = name.c_str();
  std::string values;
  for (const auto& row : transform.m)
    for (const double entry : row) values += fmt::format("{}{}", values.empty() ? "" : " ", entry);
  add_value(element, "matrix", "", values);
}

}  // namespace vitrail::mitsuba_writer
