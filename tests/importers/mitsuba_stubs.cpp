// SPDX-License-Identifier: Apache-2.0
// The least of object.cpp, report.cpp, spectra.cpp and textures.cpp that the tests of the view, the lights
// and the media need. To be deleted where the real ones are linked.
#include <algorithm>

#include "importers/mitsuba/builder.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail::mitsuba {

const Property* Object::find(std::string_view name) const {
  for (const Property& property : properties)
    if (property.name == name) {
      property.queried = true;
      return &property;
    }
  return nullptr;
}

bool Object::has(std::string_view name) const {
  return std::any_of(properties.begin(), properties.end(), [&](const Property& p) { return p.name == name; });
}

namespace {

template <class T>
const T* get(const Object& object, std::string_view name, const Report& report) {
  const Property* property = object.find(name);
  if (!property) return nullptr;
  const T* value = std::get_if<T>(&property->value);
  if (!value) report.fail("wrong type of \"" + std::string(name) + "\"", property->origin);
  return value;
}

}  // namespace

double Object::number(std::string_view name, double otherwise, const Report& report) const {
  const Property* property = find(name);
  if (const auto* integer = property ? std::get_if<long long>(&property->value) : nullptr)
    return static_cast<double>(*integer);
  const double* value = get<double>(*this, name, report);
  return value ? *value : otherwise;
}
int Object::integer(std::string_view name, int otherwise, const Report& report) const {
  const auto* value = get<long long>(*this, name, report);
  return value ? static_cast<int>(*value) : otherwise;
}
bool Object::boolean(std::string_view name, bool otherwise, const Report& report) const {
  const bool* value = get<bool>(*this, name, report);
  return value ? *value : otherwise;
}
std::string Object::text(std::string_view name, const std::string& otherwise, const Report& report) const {
  const auto* value = get<std::string>(*this, name, report);
  return value ? *value : otherwise;
}
std::optional<Vector3d> Object::vector(std::string_view name, const Report& report) const {
  const auto* value = get<Vector3d>(*this, name, report);
  return value ? std::optional(*value) : std::nullopt;
}
Transform Object::transform(std::string_view name, const Report& report) const {
  const auto* value = get<Transform>(*this, name, report);
  return value ? *value : Transform{};
}

std::vector<const Property*> Object::children(std::string_view wanted) const {
  std::vector<const Property*> all;
  for (const Property& property : properties)
    if (const auto* object = std::get_if<ObjectPtr>(&property.value); object && (*object)->tag == wanted) {
      property.queried = true;
      all.push_back(&property);
    }
  return all;
}
const Object* Object::child(std::string_view wanted) const {
  const auto all = children(wanted);
  return all.empty() ? nullptr : std::get<ObjectPtr>(all.front()->value).get();
}
void Object::ignore(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) find(name);
}

void report_unused(const Object& object, Report& report, const std::vector<std::string>&) {
  for (const Property& property : object.properties)
    if (!property.queried) report.dropped("unused \"" + property.name + "\"", property.origin);
}

void Report::add(Diagnostics more) { diagnostics_.insert(diagnostics_.end(), more.begin(), more.end()); }
void Report::add(Fidelity fidelity, std::string message, const Origin& place) {
  diagnostics_.push_back({fidelity, std::move(message), location(place), location(item_)});
}
void Report::fail(const std::string& message, const Origin& place) const {
  throw Error(message, location(place));
}
SourceLocation Report::location(const Origin& origin) const {
  return {origin.file < files_.size() ? files_[origin.file] : "", static_cast<int>(origin.line),
          static_cast<int>(origin.column)};
}

namespace {

Spectrum of_rgb(RGB c, Quantity quantity) {
  if (quantity == Quantity::emission) return emission_from_rgb(c);
  if (quantity == Quantity::unbounded) return unbounded_from_rgb(c);
  return reflectance_from_rgb(c);
}

}  // namespace

Spectrum spectrum_value(Builder& builder, const Object& object, std::string_view name, Quantity quantity,
                        const Spectrum& otherwise) {
  const Property* property = object.find(name);
  if (!property) return otherwise;
  if (const auto* rgb = std::get_if<RgbValue>(&property->value)) return of_rgb(rgb->color, quantity);
  if (const auto* table = std::get_if<SpectrumValue>(&property->value)) {
    if (table->samples.empty()) return ConstantSpectrum{static_cast<float>(table->constant)};
    return tabulate(table->samples, false);
  }
  const double value = object.number(name, 0, builder.report);
  if (quantity == Quantity::emission) return emission_from_rgb({value, value, value});
  return ConstantSpectrum{static_cast<float>(value)};
}

SpectrumParameter spectrum_parameter(Builder& builder, const Object& object, std::string_view name,
                                     Quantity quantity, const Spectrum& otherwise) {
  const Property* property = object.find(name);
  if (const auto* nested = property ? std::get_if<ObjectPtr>(&property->value) : nullptr)
    return add_texture(builder, **nested, false);
  return spectrum_value(builder, object, name, quantity, otherwise);
}

// Textures in the order of their first use, without any content.
Id<Texture> add_texture(Builder& builder, const Object& texture, bool as_float) {
  const auto [place, is_new] = builder.textures.try_emplace(
      {&texture, as_float}, Id<Texture>{static_cast<std::uint32_t>(builder.scene.textures.size())});
  if (is_new) builder.scene.textures.push_back({});
  return place->second;
}

}  // namespace vitrail::mitsuba
