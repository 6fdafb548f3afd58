// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/object.h"

#include <fmt/format.h>

#include <limits>

namespace vitrail::mitsuba {

namespace {

[[noreturn]] void wrong_type(const Object& object, const Property& property, const char* wanted,
                             const Report& report) {
  report.fail(fmt::format("\"{}\" of {} \"{}\" has to be {}", property.name, object.tag, object.type, wanted),
              property.origin);
}

template <class T>
const T* value_of(const Object& object, std::string_view name, const char* wanted, const Report& report) {
  const Property* property = object.find(name);
  if (!property) return nullptr;
  const T* value = std::get_if<T>(&property->value);
  if (!value) wrong_type(object, *property, wanted, report);
  return value;
}

}  // namespace

const Property* Object::find(std::string_view name) const {
  const Property* found = nullptr;
  for (const Property& property : properties)
    if (property.name == name) property.queried = true, found = &property;  // the last one counts
  return found;
}

bool Object::has(std::string_view name) const {
  for (const Property& property : properties)
    if (property.name == name) return true;
  return false;
}

double Object::number(std::string_view name, double otherwise, const Report& report) const {
  const Property* property = find(name);
  if (!property) return otherwise;
  if (const auto* value = std::get_if<double>(&property->value)) return *value;
  if (const auto* value = std::get_if<long long>(&property->value)) return static_cast<double>(*value);
  wrong_type(*this, *property, "a number", report);
}

int Object::integer(std::string_view name, int otherwise, const Report& report) const {
  const Property* property = find(name);
  if (!property) return otherwise;
  const auto* value = std::get_if<long long>(&property->value);
  if (!value || *value < std::numeric_limits<int>::min() || *value > std::numeric_limits<int>::max())
    wrong_type(*this, *property, "an integer", report);
  return static_cast<int>(*value);
}

bool Object::boolean(std::string_view name, bool otherwise, const Report& report) const {
  const bool* value = value_of<bool>(*this, name, "true or false", report);
  return value ? *value : otherwise;
}

std::string Object::text(std::string_view name, const std::string& otherwise, const Report& report) const {
  const auto* value = value_of<std::string>(*this, name, "a string", report);
  return value ? *value : otherwise;
}

std::optional<Vector3d> Object::vector(std::string_view name, const Report& report) const {
  const auto* value = value_of<Vector3d>(*this, name, "a point or vector", report);
  return value ? std::optional(*value) : std::nullopt;
}

std::vector<Keyframe> Object::keyframes(std::string_view name) const {
  const Property* property = find(name);
  const auto* keys = property ? std::get_if<std::vector<Keyframe>>(&property->value) : nullptr;
  return keys ? *keys : std::vector<Keyframe>{};
}

Transform Object::transform(std::string_view name, const Report& report) const {
  if (const auto keys = keyframes(name); !keys.empty()) return keys.front().transform;
  const auto* value = value_of<Transform>(*this, name, "a transform", report);
  return value ? *value : Transform{};
}

std::vector<const Property*> Object::children(std::string_view wanted) const {
  std::vector<const Property*> found;
  for (const Property& property : properties)
    if (const auto* object = std::get_if<ObjectPtr>(&property.value); object && (*object)->tag == wanted) {
      property.queried = true;
      found.push_back(&property);
    }
  return found;
}

const Object* Object::child(std::string_view wanted) const {
  const auto found = children(wanted);
  return found.empty() ? nullptr : std::get<ObjectPtr>(found.front()->value).get();
}

void Object::ignore(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) find(name);
}

namespace {

std::string what_is(const Property& property) {
  const auto* nested = std::get_if<ObjectPtr>(&property.value);
  return nested && property.name.empty() ? fmt::format("a nested {}", (*nested)->tag)
                                         : fmt::format("\"{}\"", property.name);
}

std::string suggested(const Property& property, const std::vector<std::string>& known) {
  const std::string closest = closest_word(property.name, known);
  return closest.empty() || closest == property.name ? "" : fmt::format("did you mean \"{}\"?", closest);
}

}  // namespace

std::string name_of(const Object& object) { return object.id.starts_with("_unnamed_") ? "" : object.id; }

void report_unused(const Object& object, Report& report, const std::vector<std::string>& known) {
  for (const Property& property : object.properties) {
    if (property.queried) continue;
    property.queried = true;  // said once, however many refer to the object
    const std::string hint = suggested(property, known);
    report.dropped(fmt::format("{} \"{}\": {} is not used{}", object.tag, object.type, what_is(property),
                               hint.empty() ? "" : "; " + hint),
                   property.origin);
  }
}

void report_unused_in_one(const Object& object, Report& report, const std::vector<std::string>& known) {
  std::vector<std::string> unused;
  for (const Property& property : object.properties) {
    if (property.queried) continue;
    property.queried = true;
    const std::string hint = suggested(property, known);
    unused.push_back(what_is(property) + (hint.empty() ? "" : " (" + hint + ")"));
  }
  if (unused.empty()) return;
  report.dropped(fmt::format("{} \"{}\": {} {} not used", object.tag, object.type, fmt::join(unused, ", "),
                             unused.size() == 1 ? "is" : "are"),
                 object.origin);
}

}  // namespace vitrail::mitsuba
