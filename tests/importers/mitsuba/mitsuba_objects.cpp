// SPDX-License-Identifier: Apache-2.0
#include "tests/importers/mitsuba/mitsuba_objects.h"

#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

namespace vitrail::mitsuba {

namespace {

using Known = std::map<std::string, ObjectPtr>;

std::vector<double> numbers(std::string text) {
  for (char& c : text)
    if (c == ',') c = ' ';
  std::istringstream in(text);
  std::vector<double> all;
  for (std::string word; in >> word;) all.push_back(std::strtod(word.c_str(), nullptr));
  return all;
}

Transform transform_of(pugi::xml_node element) {
  Transform t;
  for (const pugi::xml_node step : element) {
    const auto v = numbers(step.attribute("value").value());
    const Vector3d xyz{step.attribute("x").as_double(), step.attribute("y").as_double(),
                       step.attribute("z").as_double()};
    Transform own;
    if (step.name() == std::string_view("translate")) own = translate(xyz);
    if (step.name() == std::string_view("scale")) own = scale(xyz);
    if (v.size() == 16)
      for (std::size_t i = 0; i < 16; ++i) own.m[i / 4][i % 4] = v[i];
    t = own * t;
  }
  return t;
}

Value spectrum_of(const std::string& text) {
  SpectrumValue spectrum;
  if (text.find(':') == std::string::npos) {
    spectrum.constant = numbers(text).at(0);
    return spectrum;
  }
  std::string list = text;
  for (char& c : list)
    if (c == ':') c = ' ';
  const auto v = numbers(list);
  for (std::size_t i = 0; i + 1 < v.size(); i += 2) spectrum.samples.push_back({v[i], v[i + 1]});
  return spectrum;
}

ObjectPtr object_from(pugi::xml_node element, Known& known);

// The places are offsets in the text: line 1, column = offset.
Origin origin_of(pugi::xml_node element) {
  return {0, 1, static_cast<std::uint32_t>(element.offset_debug())};
}

Value value_of(pugi::xml_node element, Known& known) {
  const std::string tag = element.name(), value = element.attribute("value").value();
  if (tag == "float") return std::strtod(value.c_str(), nullptr);
  if (tag == "integer") return static_cast<long long>(std::stoll(value));
  if (tag == "boolean") return value == "true";
  if (tag == "string") return value;
  if (tag == "transform") return transform_of(element);
  if (tag == "ref") return known.at(element.attribute("id").value());
  if (tag == "point" || tag == "vector")
    return Vector3d{std::strtod(element.attribute("x").value(), nullptr),
                    std::strtod(element.attribute("y").value(), nullptr),
                    std::strtod(element.attribute("z").value(), nullptr)};
  if (tag == "rgb") {
    const auto c = numbers(value);
    return RgbValue{{c.at(0), c.at(1), c.at(2)}};
  }
  if (tag == "spectrum" && !value.empty()) return spectrum_of(value);
  return object_from(element, known);
}

ObjectPtr object_from(pugi::xml_node element, Known& known) {
  auto object = std::make_shared<Object>();
  object->tag = element.name();
  object->type = element.attribute("type").value();
  object->id = element.attribute("id").value();
  object->origin = origin_of(element);
  for (const pugi::xml_node child : element)
    if (child.type() == pugi::node_element)
      object->properties.push_back(
          {child.attribute("name").value(), value_of(child, known), origin_of(child), false});
  if (!object->id.empty()) known[object->id] = object;
  return object;
}

Object root_of(const pugi::xml_document& document) {
  Known known;
  // Media may stand after what refers to them in hand-made files; written ones come after the sensor.
  for (const pugi::xml_node element : document.child("scene"))
    if (element.name() == std::string_view("medium") || element.name() == std::string_view("texture"))
      object_from(element, known);
  Object root;
  root.tag = "scene";
  for (const pugi::xml_node element : document.child("scene")) {
    if (element.type() != pugi::node_element) continue;
    const std::string id = element.attribute("id").value();
    const bool made = known.contains(id) && known.at(id)->tag == element.name();
    root.properties.push_back(
        {"", made ? known.at(id) : object_from(element, known), origin_of(element), false});
  }
  return root;
}

}  // namespace

Object load_objects(const std::filesystem::path& file) {
  pugi::xml_document document;
  if (!document.load_file(file.c_str())) throw std::runtime_error("cannot load " + file.string());
  return root_of(document);
}

Object load_objects_of_text(const std::string& xml) {
  pugi::xml_document document;
  if (!document.load_string(("<scene>" + xml + "</scene>").c_str())) throw std::runtime_error("bad XML");
  return root_of(document);
}

void read_all(Builder& builder, const Object& root) {
  for (const Property& property : root.properties) {
    const Object& object = *std::get<ObjectPtr>(property.value);
    if (object.tag == "medium") add_medium(builder, object);
    if (object.tag == "bsdf") add_material(builder, object);
  }
  for (const Property& property : root.properties) {
    const Object& object = *std::get<ObjectPtr>(property.value);
    if (object.tag == "sensor") read_sensor(builder, object);
    if (object.tag == "integrator") read_integrator(builder, object);
    if (object.tag == "emitter") add_emitter(builder, object);
    if (object.tag == "shape")
      if (const Object* emitter = object.child("emitter")) add_area_light(builder, *emitter);
  }
  finish_integrator(builder, true);
}

}  // namespace vitrail::mitsuba
