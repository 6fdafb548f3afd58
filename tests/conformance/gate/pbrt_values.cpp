// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/pbrt_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "tests/conformance/gate/pbrt_table.h"

namespace vitrail::test::pbrt {

namespace {

struct Basic {
  char letter;
  std::string_view name;
  std::size_t numbers;  // of one value
};
constexpr Basic basics[]{{'f', "float", 1},  {'i', "integer", 1}, {'p', "point3", 3}, {'v', "vector3", 3},
                         {'n', "normal", 3}, {'u', "point2", 2},  {'g', "rgb", 3}};

bool is_color(std::string_view type) { return type == "rgb" || type == "spectrum" || type == "blackbody"; }

// All of them finite, or nothing.
std::optional<std::vector<double>> numbers_of(const Parameter& p) {
  std::vector<double> values;
  for (const Token& token : p.values) {
    const auto value = token.quoted ? std::nullopt : number_of(token);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::string wrong_numbers(const Parameter& p, const Basic& basic, std::string_view type) {
  const auto values = numbers_of(p);
  if (!values || values->empty()) return "is not a list of finite numbers";
  const bool many = type.ends_with('*');
  const std::size_t wanted = type.ends_with('4') ? 4 * basic.numbers : basic.numbers;
  if (many ? values->size() % basic.numbers != 0 : values->size() != wanted)
    return fmt::format("has {} numbers", values->size());
  if (basic.letter == 'i')
    for (const double v : *values)
      if (v != std::floor(v) || std::abs(v) > 2147483647.0) return "is not an integer";
  return "";
}

std::string wrong_samples(const std::vector<double>& values) {
  if (values.empty() || values.size() % 2 != 0) return "is not a list of wavelengths and values";
  for (std::size_t i = 2; i < values.size(); i += 2)
    if (values[i] <= values[i - 2]) return "has wavelengths that do not increase";
  return "";
}

std::string wrong_color(const Parameter& p, bool albedo) {
  if (p.type == "spectrum" && p.values.size() == 1 && p.values.front().quoted)
    return is_named_spectrum(p.values.front().text) || p.values.front().text.find('.') != std::string::npos
               ? ""
               : "is not a spectrum of pbrt's";
  const auto values = numbers_of(p);
  if (!values) return "is not a list of finite numbers";
  if (p.type == "spectrum") return wrong_samples(*values);
  if (values->size() != (p.type == "rgb" ? 3 : 1)) return fmt::format("has {} numbers", values->size());
  if (p.type != "rgb") return "";
  for (const double v : *values) {
    if (v < 0) return "has a negative component";
    if (albedo && v > 1) return "is an albedo above 1";
  }
  return "";
}

std::string wrong_texts(const Parameter& p, std::size_t wanted) {
  if (p.values.size() != wanted) return fmt::format("has {} values", p.values.size());
  for (const Token& token : p.values)
    if (!token.quoted) return "is not quoted";
  return "";
}

}  // namespace

std::optional<double> number_of(const Token& token) {
  const std::string_view text = token.text;
  const char first = text.empty() ? ' ' : text.front();
  if (token.quoted || (first != '-' && first != '+' && first != '.' && (first < '0' || first > '9')))
    return std::nullopt;
  double value = 0;
  const char* start = text.data() + (first == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(start, text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  return value;
}

std::string wrong_value(const Parameter& p, std::string_view type) {
  const char letter = type.front();
  if (p.type == "texture") return type.ends_with('t') ? wrong_texts(p, 1) : "cannot be a texture";
  if (letter == 'c' || letter == 'a') {
    if (is_color(p.type)) return wrong_color(p, letter == 'a');
    if (type == "c|f" && p.type == "float") return wrong_numbers(p, basics[0], "f");
    return fmt::format("cannot be of type {}", p.type);
  }
  if (letter == 's')
    return p.type == "string" ? wrong_texts(p, type == "s2" ? 2 : 1)
                              : fmt::format("cannot be of type {}", p.type);
  if (letter == 'b') {
    if (p.type != "bool") return fmt::format("cannot be of type {}", p.type);
    const bool fine = p.values.size() == 1 && !p.values.front().quoted &&
                      (p.values.front().text == "true" || p.values.front().text == "false");
    return fine ? "" : "is neither true nor false";
  }
  for (const Basic& basic : basics)
    if (basic.letter == letter)
      return p.type == basic.name ? wrong_numbers(p, basic, type)
                                  : fmt::format("cannot be of type {}", p.type);
  return "has no known type";
}

std::string_view type_of(std::string_view parameters, std::string_view name) {
  while (!parameters.empty()) {
    const std::size_t end = parameters.find(' ');
    const std::string_view entry = parameters.substr(0, end);
    const std::size_t colon = entry.find(':');
    if (entry.substr(0, colon) == name) return entry.substr(colon + 1);
    parameters = end == std::string_view::npos ? "" : parameters.substr(end + 1);
  }
  return "";
}

}  // namespace vitrail::test::pbrt
