// SPDX-License-Identifier: Apache-2.0
// Objects are those of a Mitsuba file after includes, defaults, aliases and references. They form a tree
// whose shared parts are shared.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "importers/mitsuba/read/report.h"
#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail::mitsuba {

struct Object;
using ObjectPtr = std::shared_ptr<const Object>;

// They are <rgb>, and <spectrum value="…"> in its three forms. `filename` is absolute.
struct RgbValue {
  RGB color;
};
struct SpectrumValue {
  double constant = 0;  // where both others are empty
  std::vector<SpectrumSample> samples;
  std::string filename;
};

using Value = std::variant<bool, long long, double, std::string, Vector3d, RgbValue, SpectrumValue, Transform,
                           std::vector<Keyframe>, ObjectPtr>;

struct Property {
  std::string name;  // "" of a nested object without one
  Value value;
  Origin origin;
  mutable bool queried = false;
};

// It is a plugin and its parameters. Every property that is looked up counts as queried; the rest is reported
// as unused. Names are those of Mitsuba 3 (older spellings are translated when the file is loaded).
struct Object {
  std::string tag;   // "shape", "bsdf", "emitter", "texture", "spectrum", "sensor", "film", "medium" …
  std::string type;  // "sphere"
  std::string id;    // "" where the file gives none
  Origin origin;
  std::vector<Property> properties;

  // Returns the property of that name, if there is one.
  const Property* find(std::string_view name) const;
  bool has(std::string_view name) const;  // does not count as a query

  // They return values of a type; the default where the property is absent. Integers are numbers too. A
  // property of another type throws Error at its place.
  double number(std::string_view name, double otherwise, const Report& report) const;
  int integer(std::string_view name, int otherwise, const Report& report) const;
  bool boolean(std::string_view name, bool otherwise, const Report& report) const;
  std::string text(std::string_view name, const std::string& otherwise, const Report& report) const;
  std::optional<Vector3d> vector(std::string_view name, const Report& report) const;
  // Returns the identity where the property is absent, and the first keyframe where it moves.
  Transform transform(std::string_view name, const Report& report) const;
  // Returns the keyframes in order; none where it does not move.
  std::vector<Keyframe> keyframes(std::string_view name) const;

  // Returns the nested objects of a tag, whatever their names, in order. Marks them as queried.
  std::vector<const Property*> children(std::string_view tag) const;
  // Returns the first of them, or nothing.
  const Object* child(std::string_view tag) const;

  // Counts properties as queried that change nothing in the picture.
  void ignore(std::initializer_list<std::string_view> names) const;
};

// Returns "" where the file gives none.
std::string name_of(const Object& object);

// Adds a diagnostic for each property that was not queried, with a suggestion from the names in `known`.
void report_unused(const Object& object, Report& report, const std::vector<std::string>& known = {});

// Adds the same as one diagnostic, for objects that say how to sample, not what to show.
void report_unused_in_one(const Object& object, Report& report, const std::vector<std::string>& known);

}  // namespace vitrail::mitsuba
