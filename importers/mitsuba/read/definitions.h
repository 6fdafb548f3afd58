// SPDX-License-Identifier: Apache-2.0
// Definitions give the values that stand for $name in attributes.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "importers/mitsuba/read/report.h"

namespace vitrail::mitsuba {

class Definitions {
 public:
  // `given` stand before the <default>s of the same names.
  Definitions(const std::map<std::string, std::string>& given, const Report& report)
      : report_(report), given_(given), values_(given) {}

  // Takes a <default>. The first of a name counts.
  void add(const std::string& name, const std::string& value);

  // Returns the name of the first variable in the text that has no value; "" where all have one.
  std::string undefined_in(const std::string& text) const;

  // Returns the text with a value for each $name: the longest known name that follows a "$". Throws Error for
  // a name that is not known, and for a text that grows without bound.
  std::string expanded(const std::string& text, const Origin& place);

  // Returns the value of a name, which does not count as asked for; null where it has none.
  const std::string* find(const std::string& name) const;

  // Throws Error where the scene never asks for one of those that were given.
  void require_given(const std::filesystem::path& scene) const;

 private:
  struct Variable {
    std::string letters;  // that follow the "$", as far as a name may go
    std::size_t known;    // of these, those of the longest name that has a value; 0: none has
  };
  Variable variable_at(const std::string& text, std::size_t begin) const;

  const Report& report_;
  const std::map<std::string, std::string> given_;
  std::map<std::string, std::string> values_;
  std::set<std::string> parameters_;  // that the scene has
  std::size_t expanded_bytes_ = 0;
};

}  // namespace vitrail::mitsuba
