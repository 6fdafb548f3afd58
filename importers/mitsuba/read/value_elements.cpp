// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/value_elements.h"

#include <memory>

#include "importers/mitsuba/read/old_versions.h"
#include "importers/mitsuba/read/transform_elements.h"

namespace vitrail::mitsuba {

namespace {

std::string read_string(const Element& element, const SearchFolders& folders) {
  const std::string text = element.required("value"), name = element.name();
  return name == "filename" || name == "glazing" ? folders.resolve(text).string() : text;
}

RgbValue read_srgb(const Element& element) {
  const std::string text = element.required("value");
  const RGB c = parse_rgb(text, element.failing());
  if (text.starts_with('#')) return {c};
  return {{srgb_decode(c.r), srgb_decode(c.g), srgb_decode(c.b)}};
}

Value read_spectrum(const Element& element, const Object& owner, const SearchFolders& folders) {
  if (!element.has("filename")) {
    const std::string text = element.required("value");
    if (element.is_old() && is_color_of_old_file(text, owner))
      return RgbValue{parse_rgb(text, element.failing())};
    return parse_spectrum(text, element.failing());
  }
  SpectrumValue spectrum;
  spectrum.filename = folders.resolve(element.attribute("filename")).string();
  return spectrum;
}

// 0.6's element is 3's plugin.
ObjectPtr read_blackbody(const Element& element) {
  auto object = std::make_shared<Object>();
  object->tag = "spectrum";
  object->type = "blackbody";
  object->origin = element.place();
  const auto add = [&](const char* name, const std::string& text) {
    object->properties.push_back({name, parse_number(text, element.failing()), element.place()});
  };
  std::string kelvin = element.required("temperature");
  if (kelvin.ends_with('K') || kelvin.ends_with('k')) kelvin.pop_back();
  add("temperature", kelvin);
  if (element.has("scale")) add("scale", element.attribute("scale"));
  return object;
}

}  // namespace

Value read_value(const Element& element, const Object& owner, const SearchFolders& folders) {
  const std::string tag = element.tag();
  const Fail fails = element.failing();
  const auto value = [&] { return element.required("value"); };
  if (tag == "boolean") return parse_boolean(value(), fails);
  if (tag == "integer") return parse_integer(value(), fails);
  if (tag == "float") return parse_number(value(), fails);
  if (tag == "string") return read_string(element, folders);
  if (tag == "vector" || tag == "point") return read_triple(element, 0);
  if (tag == "rgb") return RgbValue{parse_rgb(value(), fails)};
  if (tag == "srgb") return read_srgb(element);
  if (tag == "spectrum") return read_spectrum(element, owner, folders);
  if (tag == "blackbody") return read_blackbody(element);
  if (tag == "transform") return read_transform(element);
  if (tag == "animation") return read_animation(element);
  element.fail_unknown();
}

}  // namespace vitrail::mitsuba
