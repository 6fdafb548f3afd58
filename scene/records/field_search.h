// SPDX-License-Identifier: Apache-2.0
// It goes through the fields of records in search of something.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene/records/fields.h"

namespace vitrail {

// `in` of a record goes to `in` of each of its fields, and so on. Derived has `using FieldSearch::in`, and an
// `in` of its own for each kind of field that it looks for. A record without a list of its fields does not
// compile.
template <class Derived>
struct FieldSearch {
  // Searches the value that an optional holds, where it holds one.
  template <class T>
  void in(const std::optional<T>& field) {
    if (field) self().in(*field);
  }
  // Searches the alternative that a variant holds.
  template <class... T>
  void in(const std::variant<T...>& field) {
    std::visit([this](const auto& alternative) { self().in(alternative); }, field);
  }
  // Searches each item.
  template <class T>
  void in(const std::vector<T>& list) {
    for (const T& item : list) self().in(item);
  }
  // Searches the record's fields.
  template <HasFields Record>
  void in(const Record& record) {
    visit_fields(record, [this](const auto&... fields) { (self().in(fields), ...); });
  }
  // These fields can hold no texture: they are passed over.
  template <class T>
  requires(!std::is_class_v<T>) void in(const T&) {}
  template <class T>
  requires(std::constructible_from<Spectrum, T>) void in(const T&) {}
  template <class T>
  void in(const Id<T>&) {}
  template <class T, std::size_t n>
  void in(const std::array<T, n>&) {}
  void in(const std::string&) {}
  void in(const Vector3d&) {}
  void in(const Point3d&) {}
  void in(const Transform&) {}
  void in(const MeasuredSheet&) {}

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
};

}  // namespace vitrail
