// SPDX-License-Identifier: Apache-2.0
// An Element is an element of a Mitsuba file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "importers/mitsuba/read/definitions.h"
#include "importers/mitsuba/read/values.h"

namespace vitrail::mitsuba {

// They hold where the lines of a text begin.
class Lines {
 public:
  Lines(const char* begin, const char* end) {
    starts_.push_back(0);
    for (const char* at = begin; at < end; ++at)
      if (*at == '\n') starts_.push_back(at - begin + 1);
  }
  Origin origin(std::uint32_t file, std::ptrdiff_t offset) const {
    const auto above = std::upper_bound(starts_.begin(), starts_.end(), std::max<std::ptrdiff_t>(offset, 0));
    const auto line = static_cast<std::uint32_t>(above - starts_.begin());
    return {file, line, static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(offset, 0) - *(above - 1) + 1)};
  }

 private:
  std::vector<std::ptrdiff_t> starts_;
};

// It is a file that is being read.
struct Source {
  std::uint32_t number;
  Lines lines;
  bool is_old = false;  // before version 2: names are in camel case

  Origin origin(pugi::xml_node node) const { return lines.origin(number, node.offset_debug() - 1); }
};

// It knows its place and its attributes, in which definitions are put in.
class Element {
 public:
  Element(pugi::xml_node node, const Source& source, Definitions& definitions, const Report& report)
      : node_(node),
        source_(source),
        definitions_(definitions),
        report_(report),
        place_(source.origin(node)) {}
  Element child(pugi::xml_node node) const { return {node, source_, definitions_, report_}; }

  pugi::xml_node node() const { return node_; }
  const Origin& place() const { return place_; }
  const Source& source() const { return source_; }
  bool is_old() const { return source_.is_old; }

  std::string tag() const;  // of today
  bool is_object() const;   // a plugin, not a value
  bool has(const char* name) const { return !node_.attribute(name).empty(); }
  std::string attribute(const char* name) const;  // "" where it is absent
  std::string required(const char* name) const;   // without it throws Error
  std::string name() const;                       // the attribute "name", as it is spelled today

  [[noreturn]] void fail(const std::string& message) const { report_.fail(message, place_); }
  Fail failing() const {
    return [this](const std::string& message) { fail(message); };
  }
  // Reports a tag that Mitsuba does not have.
  [[noreturn]] void fail_unknown() const;

 private:
  pugi::xml_node node_;
  const Source& source_;
  Definitions& definitions_;
  const Report& report_;
  Origin place_;
};

}  // namespace vitrail::mitsuba
