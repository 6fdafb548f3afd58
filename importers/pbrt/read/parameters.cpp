// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrail::pbrt {

namespace {

struct TypeName {
  std::string_view name;
  ParameterType type;
};

constexpr std::array<TypeName, 19> type_names{{{"bool", ParameterType::boolean},
                                               {"integer", ParameterType::integer},
                                               {"float", ParameterType::number},
                                               {"point", ParameterType::tuple},
                                               {"point2", ParameterType::tuple},
                                               {"point3", ParameterType::tuple},
                                               {"vector", ParameterType::tuple},
                                               {"vector2", ParameterType::tuple},
                                               {"vector3", ParameterType::tuple},
                                               {"normal", ParameterType::tuple},
                                               {"normal3", ParameterType::tuple},
                                               {"rgb", ParameterType::rgb},
                                               {"color", ParameterType::rgb},
                                               {"xyz", ParameterType::xyz},
                                               {"blackbody", ParameterType::blackbody},
                                               {"spectrum", ParameterType::spectrum},
                                               {"string", ParameterType::text},
                                               {"texture", ParameterType::texture},
                                               {"int", ParameterType::integer}}};

std::string with_suggestion(std::string message, const std::string& word,
                            const std::vector<std::string>& known) {
  const std::string closest = closest_word(word, known);
  return closest.empty() || closest == word ? message
                                            : fmt::format("{}; did you mean \"{}\"?", message, closest);
}

// "type name" → an empty parameter of that type and name.
Parameter parse_declaration(const Token& token) {
  constexpr std::string_view blanks = " \t";
  const auto type_begin = token.text.find_first_not_of(blanks);
  const auto type_end = token.text.find_first_of(blanks, type_begin);
  const auto name_begin = token.text.find_first_not_of(blanks, type_end);
  if (type_begin == std::string_view::npos || name_begin == std::string_view::npos)
    fail(fmt::format("expected a parameter \"type name\", found {}", describe(token)), token.place);
  const std::string type(token.text.substr(type_begin, type_end - type_begin));
  const auto name_end = token.text.find_last_not_of(blanks) + 1;
  const auto known = std::find_if(type_names.begin(), type_names.end(),
                                  [&](const TypeName& entry) { return entry.name == type; });
  if (known == type_names.end()) {
    std::vector<std::string> names;
    for (const TypeName& entry : type_names) names.emplace_back(entry.name);
    fail(with_suggestion(fmt::format("unknown parameter type \"{}\"", type), type, names), token.place);
  }
  Parameter parameter;
  parameter.type = known->type;
  parameter.name = token.text.substr(name_begin, name_end - name_begin);
  parameter.place = token.place;
  return parameter;
}

// Adds the value that `token` is; false if the type of the parameter has no such values.
bool add_value(Parameter& parameter, const Token& token) {
  const bool string = token.kind == TokenKind::text;
  switch (parameter.type) {
    case ParameterType::boolean:
      if (token.text != "true" && token.text != "false") return false;
      parameter.numbers.push_back(token.text == "true" ? 1 : 0);
      return true;
    case ParameterType::text:
    case ParameterType::texture:
    case ParameterType::spectrum:
      if (string) parameter.strings.emplace_back(token.text);
      return string;
    default:
      return false;
  }
}

const char* expected_value(ParameterType type) {
  switch (type) {
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::text:
    case ParameterType::texture:
      return "a string";
    case ParameterType::spectrum:
      return "a number or a string";
    default:
      return "a number";
  }
}

// A whole number of 32 bits. A fraction is cut off, as pbrt-v3 does.
std::int32_t checked_integer(double value, const Parameter& parameter, bool& cut) {
  if (std::abs(value) > std::numeric_limits<std::int32_t>::max())
    fail(fmt::format("integer parameter \"{}\" has the value {}, which is out of range", parameter.name,
                     value),
         parameter.place);
  const auto whole = static_cast<std::int32_t>(value);
  cut |= whole != value;
  return whole;
}

void report_cut(const Parameter& parameter, Report& report) {
  report.approximated(fmt::format("integer parameter \"{}\": fractions are cut off", parameter.name),
                      parameter.place);
}

constexpr std::size_t most_in_numbers = 4096;  // longer lists are long ones

// What a list of this kind may be narrowed to: pbrt itself has floats. Points keep doubles, because meshes
// far from the origin are moved before they are rounded; so do spectra, which are computed with. So
// many numbers of one colour are a grid.
LongList empty_list(const Parameter& parameter) {
  if (parameter.type == ParameterType::integer) return GrowingArray<std::int32_t>();
  const bool narrow = (parameter.type == ParameterType::tuple && parameter.name != "P") ||
                      parameter.type == ParameterType::number || parameter.type == ParameterType::rgb;
  if (narrow) return GrowingArray<float>();
  return GrowingArray<double>();
}

// The rest of a list of which the first are in `numbers`.
void read_long_list(TokenStream& tokens, Parameter& parameter, Report& report) {
  constexpr std::size_t release_interval = 1u << 16;
  bool cut = false;
  parameter.long_list = tokens.skips_lists() ? LongList(SkippedNumbers()) : empty_list(parameter);
  std::visit(
      [&]<class List>(List& list) {
        const auto add = [&](double value) {
          if constexpr (std::is_same_v<List, GrowingArray<std::int32_t>>)
            list.push_back(checked_integer(value, parameter, cut));
          else if constexpr (std::is_same_v<List, GrowingArray<float>>)
            list.push_back(static_cast<float>(value));
          else
            list.push_back(value);
        };
        for (const double value : parameter.numbers) add(value);
        for (double value = 0; tokens.next_number(value);) {
          add(value);
          if (list.size() % release_interval == 0) tokens.release();
        }
      },
      *parameter.long_list);
  if (cut) report_cut(parameter, report);
  parameter.numbers = {};
}

void read_values(TokenStream& tokens, Parameter& parameter, Report& report) {
  const bool numeric = parameter.type != ParameterType::boolean && parameter.type != ParameterType::text &&
                       parameter.type != ParameterType::texture;
  double value = 0;
  if (numeric && tokens.next_number(value)) {
    parameter.numbers.push_back(value);
    return;
  }
  const auto unexpected = [&](const Token& token) {
    fail(fmt::format("expected {} for parameter \"{}\", found {}", expected_value(parameter.type),
                     parameter.name, describe(token)),
         token.place);
  };
  Token token = tokens.next();
  if (token.kind != TokenKind::open) {
    if (!add_value(parameter, token)) unexpected(token);
    return;
  }
  for (;;) {
    if (numeric)
      while (parameter.numbers.size() < most_in_numbers && tokens.next_number(value))
        parameter.numbers.push_back(value);
    if (parameter.numbers.size() == most_in_numbers) read_long_list(tokens, parameter, report);
    token = tokens.next();
    if (token.kind == TokenKind::close) break;
    if (!add_value(parameter, token)) unexpected(token);
  }
}

// The integers of a short list; long ones have been looked at as they were read.
void check_integers(Parameter& parameter, Report& report) {
  bool cut = false;
  for (double& value : parameter.numbers) value = checked_integer(value, parameter, cut);
  if (cut) report_cut(parameter, report);
}

}  // namespace

std::size_t number_count(const Parameter& parameter) {
  if (!parameter.long_list) return parameter.numbers.size();
  return std::visit([](const auto& list) { return list.size(); }, *parameter.long_list);
}

namespace {

Parameter read_parameter(const Token& declaration, TokenStream& tokens, Report& report) {
  Parameter parameter = parse_declaration(declaration);
  read_values(tokens, parameter, report);
  if (parameter.type == ParameterType::integer) check_integers(parameter, report);
  if (parameter.type == ParameterType::spectrum && !parameter.strings.empty() && number_count(parameter) > 0)
    fail(fmt::format("spectrum parameter \"{}\" mixes numbers and strings", parameter.name), parameter.place);
  return parameter;
}

// The type is that of the value.
Parameter read_bare_value(const Token& name, TokenStream& tokens) {
  Parameter parameter;
  parameter.name = name.text;
  parameter.place = name.place;
  double value = 0;
  if (tokens.next_number(value)) {
    parameter.numbers.push_back(value);
    return parameter;
  }
  const Token token = tokens.next();
  parameter.type = token.kind == TokenKind::text ? ParameterType::text : ParameterType::boolean;
  if (!add_value(parameter, token))
    fail(fmt::format("expected a value for the option \"{}\", found {}", parameter.name, describe(token)),
         token.place);
  return parameter;
}

}  // namespace

std::vector<Parameter> read_parameters(TokenStream& tokens, Report& report) {
  std::vector<Parameter> parameters;
  while (tokens.text_follows()) parameters.push_back(read_parameter(tokens.next(), tokens, report));
  return parameters;
}

std::vector<Parameter> read_options(TokenStream& tokens, Report& report) {
  const Token first = tokens.next();
  if (first.kind != TokenKind::text)
    fail(fmt::format("expected the name of an option in quotes, found {}", describe(first)), first.place);
  const bool is_declaration = first.text.find_first_of(" \t") != std::string_view::npos;
  if (!is_declaration) return {read_bare_value(first, tokens)};
  std::vector<Parameter> parameters{read_parameter(first, tokens, report)};
  for (Parameter& more : read_parameters(tokens, report)) parameters.push_back(std::move(more));
  return parameters;
}

ParameterSet::ParameterSet(std::string owner, const Place& place, std::vector<Parameter> parameters,
                           const std::vector<Parameter>* defaults)
    : owner_(std::move(owner)), place_(place), parameters_(std::move(parameters)) {
  if (defaults) parameters_.insert(parameters_.begin(), defaults->begin(), defaults->end());
}

Parameter* ParameterSet::find_as_it_is(std::string_view name, std::initializer_list<ParameterType> types) {
  asked_.emplace_back(name);
  for (auto parameter = parameters_.rbegin(); parameter != parameters_.rend(); ++parameter) {
    if (parameter->name != name || std::find(types.begin(), types.end(), parameter->type) == types.end())
      continue;
    parameter->used = true;
    return &*parameter;
  }
  return nullptr;
}

Parameter* ParameterSet::find(std::string_view name, std::initializer_list<ParameterType> types) {
  Parameter* const parameter = find_as_it_is(name, types);
  if (parameter && parameter->long_list) {
    std::vector<double> numbers;
    if (std::holds_alternative<SkippedNumbers>(*parameter->long_list))
      fail(fmt::format("parameter \"{}\" has too many numbers to be skimmed", name), parameter->place);
    numbers.reserve(number_count(*parameter));
    consume_numbers(*parameter, 1,
                    [&](auto values) { numbers.insert(numbers.end(), values.begin(), values.end()); });
    parameter->numbers = std::move(numbers);
  }
  return parameter;
}

Parameter* ParameterSet::find_spectrum(std::string_view name) {
  return find(name, {ParameterType::number, ParameterType::rgb, ParameterType::xyz, ParameterType::blackbody,
                     ParameterType::spectrum});
}

Parameter* ParameterSet::find_numbers(std::string_view name) {
  return find(name, {ParameterType::number, ParameterType::integer, ParameterType::tuple});
}

Parameter* ParameterSet::find_list(std::string_view name) {
  return find_as_it_is(name, {ParameterType::number, ParameterType::integer, ParameterType::tuple});
}

Parameter* ParameterSet::find_grid(std::string_view name) {
  return find_as_it_is(
      name, {ParameterType::number, ParameterType::integer, ParameterType::tuple, ParameterType::rgb,
             ParameterType::xyz, ParameterType::blackbody, ParameterType::spectrum});
}

namespace {

void require_count(const Parameter& parameter, std::size_t found, std::size_t expected) {
  if (found != expected)
    fail(fmt::format("parameter \"{}\" needs {} value{}, has {}", parameter.name, expected,
                     expected == 1 ? "" : "s", found),
         parameter.place);
}

}  // namespace

double ParameterSet::number(std::string_view name, double otherwise) {
  const Parameter* parameter = find(name, {ParameterType::number, ParameterType::integer});
  if (!parameter) return otherwise;
  require_count(*parameter, parameter->numbers.size(), 1);
  return parameter->numbers[0];
}

int ParameterSet::integer(std::string_view name, int otherwise) {
  const Parameter* parameter = find(name, {ParameterType::integer});
  if (!parameter) return otherwise;
  require_count(*parameter, parameter->numbers.size(), 1);
  return static_cast<int>(parameter->numbers[0]);
}

bool ParameterSet::boolean(std::string_view name, bool otherwise) {
  const Parameter* parameter = find(name, {ParameterType::boolean});
  if (!parameter) return otherwise;
  require_count(*parameter, parameter->numbers.size(), 1);
  return parameter->numbers[0] != 0;
}

std::string ParameterSet::text(std::string_view name, const std::string& otherwise) {
  const Parameter* parameter = find(name, {ParameterType::text});
  if (!parameter) return otherwise;
  require_count(*parameter, parameter->strings.size(), 1);
  return parameter->strings[0];
}

std::optional<std::array<double, 3>> ParameterSet::triple(std::string_view name) {
  const Parameter* parameter = find_numbers(name);
  if (!parameter) return std::nullopt;
  require_count(*parameter, parameter->numbers.size(), 3);
  return std::array<double, 3>{parameter->numbers[0], parameter->numbers[1], parameter->numbers[2]};
}

void ParameterSet::ignore(std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    asked_.emplace_back(name);
    for (Parameter& parameter : parameters_)
      if (parameter.name == name) parameter.used = true;
  }
}

void ParameterSet::report_unused(Report& report) const {
  for (const Parameter& parameter : parameters_) {
    if (parameter.used || parameter.from_attribute) continue;
    const bool known = std::find(asked_.begin(), asked_.end(), parameter.name) != asked_.end();
    const std::string message =
        fmt::format("parameter \"{}\" of {} {}", parameter.name, owner_,
                    known ? "is given more than once or has a type that is not read here" : "is not used");
    report.dropped(known ? message : with_suggestion(message, parameter.name, asked_), parameter.place);
  }
}

}  // namespace vitrail::pbrt
