// SPDX-License-Identifier: Apache-2.0
// A JsonNode is a place in a JSON file: what is read there, and what errors say of it. For glazing alone.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace vitrail {

// Throws Error with line and column where a text is no JSON.
class JsonNode {
 public:
  static JsonNode parse(const std::string& text, const std::string& file);

  bool is_object() const { return json_->is_object(); }
  bool is_array() const { return json_->is_array(); }
  bool is_text() const { return json_->is_string(); }
  bool is_null() const { return json_->is_null(); }

  // They return the member of that name. If it is absent or null, find returns nothing and `at` throws Error.
  std::optional<JsonNode> find(const std::string& key) const;
  JsonNode at(const std::string& key) const;
  std::vector<JsonNode> items() const;                            // of an array
  std::vector<std::pair<std::string, JsonNode>> members() const;  // of an object

  double number() const;  // finite; Error elsewhere
  bool boolean() const;
  std::string text() const;
  double number_or(const std::string& key, double otherwise) const;
  std::string text_or(const std::string& key, const std::string& otherwise) const;

  // Throws Error "FILE: /layers/1/pane: message".
  [[noreturn]] void fail(const std::string& message) const;
  // Throws Error where a member is none of these: a word that is misspelt is not passed over.
  void only(std::initializer_list<std::string_view> known) const;

 private:
  JsonNode(std::shared_ptr<const nlohmann::json> root, const nlohmann::json* json, std::string place,
           std::shared_ptr<const std::string> file)
      : root_(std::move(root)), json_(json), place_(std::move(place)), file_(std::move(file)) {}
  JsonNode below(const nlohmann::json& json, const std::string& key) const;

  std::shared_ptr<const nlohmann::json> root_;
  const nlohmann::json* json_;
  std::string place_;
  std::shared_ptr<const std::string> file_;
};

}  // namespace vitrail
