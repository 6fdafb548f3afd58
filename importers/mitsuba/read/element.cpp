// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/element.h"

#include <fmt/format.h>

#include <array>

#include "importers/mitsuba/read/old_versions.h"

namespace vitrail::mitsuba {

namespace {

constexpr std::array object_tags{"scene",    "shape",  "bsdf",   "emitter",    "texture",
                                 "spectrum", "sensor", "film",   "rfilter",    "sampler",
                                 "medium",   "phase",  "volume", "integrator", "subsurface"};
constexpr std::array value_tags{"boolean", "integer", "float",     "string",    "vector", "point",
                                "rgb",     "srgb",    "transform", "blackbody", "ref",    "include",
                                "default", "path",    "alias",     "animation"};

}  // namespace

std::string Element::tag() const { return tag_of_today(node_.name()); }

bool Element::is_object() const {
  const std::string own = tag();
  const bool by_value = own == "spectrum" && !has("type");
  return !by_value && std::ranges::find(object_tags, own) != object_tags.end();
}

std::string Element::attribute(const char* name) const {
  return definitions_.expanded(node_.attribute(name).value(), place_);
}

std::string Element::required(const char* name) const {
  if (!has(name)) fail(fmt::format("<{}> needs an attribute \"{}\"", node_.name(), name));
  return attribute(name);
}

std::string Element::name() const {
  const std::string name = attribute("name");
  return is_old() ? name_of_today(name) : name;
}

void Element::fail_unknown() const {
  std::vector<std::string> known(object_tags.begin(), object_tags.end());
  known.insert(known.end(), value_tags.begin(), value_tags.end());
  const std::string closest = closest_word(tag(), known);
  fail(fmt::format("<{}> is not known{}", tag(),
                   closest.empty() ? "" : fmt::format("; did you mean <{}>?", closest)));
}

}  // namespace vitrail::mitsuba
