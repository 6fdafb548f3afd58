// SPDX-License-Identifier: Apache-2.0
#include "glazing/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail {

JsonNode JsonNode::parse(const std::string& text, const std::string& file) {
  try {
    auto root = std::make_shared<const nlohmann::json>(nlohmann::json::parse(text));
    const nlohmann::json* json = root.get();
    return {std::move(root), json, "", std::make_shared<const std::string>(file)};
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t byte = std::min(error.byte == 0 ? 0 : error.byte - 1, text.size());
    const auto line =
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n'));
    const std::size_t begin = byte == 0 ? 0 : text.rfind('\n', byte - 1) + 1;  // npos + 1 is 0
    throw Error("is not JSON from here on", {file, line + 1, static_cast<int>(byte - begin) + 1},
                text.substr(byte, 40));
  } catch (const nlohmann::json::exception& error) {  // a number beyond all doubles
    throw Error(fmt::format("cannot be read as JSON: {}", error.what()), {file});
  }
}

void JsonNode::fail(const std::string& message) const {
  throw Error(place_.empty() ? message : fmt::format("{}: {}", place_, message), {*file_});
}

JsonNode JsonNode::below(const nlohmann::json& json, const std::string& key) const {
  return {root_, &json, fmt::format("{}/{}", place_, key), file_};
}

std::optional<JsonNode> JsonNode::find(const std::string& key) const {
  if (!is_object()) fail("has to be an object");
  const auto member = json_->find(key);
  if (member == json_->end() || member->is_null()) return {};
  return below(*member, key);
}

JsonNode JsonNode::at(const std::string& key) const {
  if (auto member = find(key)) return *member;
  fail(fmt::format("needs \"{}\"", key));
}

std::vector<JsonNode> JsonNode::items() const {
  if (!is_array()) fail("has to be a list");
  std::vector<JsonNode> result;
  for (std::size_t i = 0; i < json_->size(); ++i) result.push_back(below((*json_)[i], std::to_string(i)));
  return result;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!is_object()) fail("has to be an object");
  std::vector<std::pair<std::string, JsonNode>> result;
  for (const auto& [key, value] : json_->items()) result.emplace_back(key, below(value, key));
  return result;
}

double JsonNode::number() const {
  if (!json_->is_number()) fail("has to be a number");
  const double value = json_->get<double>();
  if (!std::isfinite(value)) fail("has to be a finite number");
  return value;
}

bool JsonNode::boolean() const {
  if (!json_->is_boolean()) fail("has to be true or false");
  return json_->get<bool>();
}

std::string JsonNode::text() const {
  if (!json_->is_string()) fail("has to be a text");
  return json_->get<std::string>();
}

double JsonNode::number_or(const std::string& key, double otherwise) const {
  const auto member = find(key);
  return member ? member->number() : otherwise;
}

std::string JsonNode::text_or(const std::string& key, const std::string& otherwise) const {
  const auto member = find(key);
  return member ? member->text() : otherwise;
}

void JsonNode::only(std::initializer_list<std::string_view> known) const {
  for (const auto& [key, value] : members())
    if (std::ranges::find(known, key) == known.end()) {
      const std::string meant = closest_word(key, {known.begin(), known.end()});
      fail(fmt::format("knows no \"{}\"{}", key, meant.empty() ? "" : fmt::format("; \"{}\"?", meant)));
    }
}

}  // namespace vitrail
