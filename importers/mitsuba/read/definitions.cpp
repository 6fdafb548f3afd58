// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/definitions.h"

#include <fmt/format.h>

#include <cctype>

namespace vitrail::mitsuba {

namespace {

constexpr std::size_t most_expanded = 1 << 20;  // bytes of an attribute after defaults are put in
constexpr std::size_t most_expanded_in_all = 64 << 20;

}  // namespace

void Definitions::add(const std::string& name, const std::string& value) {
  parameters_.insert(name);
  values_.try_emplace(name, value);
}

Definitions::Variable Definitions::variable_at(const std::string& text, std::size_t begin) const {
  std::size_t end = begin;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
    ++end;
  std::size_t known = end - begin;
  while (known > 0 && !values_.contains(text.substr(begin, known))) --known;
  return {text.substr(begin, end - begin), known};
}

std::string Definitions::undefined_in(const std::string& text) const {
  for (std::size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at + 1))
    if (const Variable variable = variable_at(text, at + 1); variable.known == 0) return variable.letters;
  return "";
}

std::string Definitions::expanded(const std::string& text, const Origin& place) {
  if (text.find('$') == std::string::npos) return text;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      result += text[i++];
      continue;
    }
    const auto [letters, known] = variable_at(text, ++i);
    if (known == 0) report_.fail(fmt::format("\"${}\" has no <default>", letters), place);
    const std::string name = letters.substr(0, known);
    parameters_.insert(name);
    result += values_[name];
    i += known;
    if (result.size() > most_expanded)
      report_.fail("an attribute grows without bound by its defaults", place);
  }
  expanded_bytes_ += result.size();
  if (expanded_bytes_ > most_expanded_in_all)
    report_.fail("the attributes grow without bound by their defaults", place);
  return result;
}

const std::string* Definitions::find(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

void Definitions::require_given(const std::filesystem::path& scene) const {
  for (const auto& [name, value] : given_) {
    if (parameters_.contains(name)) continue;
    const std::string known = fmt::format("{}", fmt::join(parameters_, ", "));
    throw Error(fmt::format("the scene has no parameter \"{}\"; {}", name,
                            known.empty() ? "it has none" : "it has " + known),
                {scene.string()});
  }
}

}  // namespace vitrail::mitsuba
