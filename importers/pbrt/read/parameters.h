// SPDX-License-Identifier: Apache-2.0
// A parameter list has "type name" followed by one value or by values in brackets.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "importers/pbrt/read/long_list.h"
#include "importers/pbrt/read/report.h"
#include "importers/pbrt/read/token_stream.h"

namespace vitrail::pbrt {

enum class ParameterType { boolean, integer, number, tuple, rgb, xyz, blackbody, spectrum, text, texture };

// `numbers` holds all values that are not strings; true is 1. A spectrum has strings (a name or a file) or
// numbers (wavelength in nm and value, alternating).
// Lists of very many numbers are in `long_list`, and move to `numbers` when they are asked for there.
struct Parameter {
  ParameterType type = ParameterType::number;
  std::string name;
  Place place;
  std::vector<double> numbers;
  std::optional<LongList> long_list;
  std::vector<std::string> strings;
  bool from_attribute = false;
  bool used = false;
};

std::size_t number_count(const Parameter& parameter);

// Calls visit(span) with the numbers in order, in spans of a multiple of `group` but for the last. A long
// list is gone then.
template <class Visit>
void consume_numbers(Parameter& parameter, std::size_t group, Visit&& visit) {
  if (!parameter.long_list) return visit(std::span<const double>(parameter.numbers));
  std::visit([&](auto& list) { list.consume(visit, group); }, *parameter.long_list);
  parameter.long_list.reset();
}

// Reads the list that follows a directive. Types of v4 and v3 (point, color …) are both known; a point,
// vector or normal of any size is a tuple. Malformed values throw Error.
std::vector<Parameter> read_parameters(TokenStream& tokens, Report& report);

// Reads what follows Option: a name and a bare value, as pbrt-v4 has it ("seed" 3), or a list as of any
// directive.
std::vector<Parameter> read_options(TokenStream& tokens, Report& report);

// It has the parameters of one directive. It remembers which were used and which names were asked for.
class ParameterSet {
 public:
  // `owner` and `place` are the directive's: "Shape \"sphere\"". Of parameters with one name the last counts;
  // those of `defaults` (Attribute) count only where the directive has none.
  ParameterSet(std::string owner, const Place& place, std::vector<Parameter> parameters,
               const std::vector<Parameter>* defaults = nullptr);

  // Returns the parameter of that name if its type is one of those given, else nothing. Marks it as used.
  Parameter* find(std::string_view name, std::initializer_list<ParameterType> types);
  Parameter* find_spectrum(std::string_view name);  // number, rgb, xyz, blackbody or spectrum
  Parameter* find_numbers(std::string_view name);   // numbers, integers or tuples
  Parameter* find_list(std::string_view name);      // the same, as a long list if it is one
  Parameter* find_grid(std::string_view name);      // of numbers or colours, as a long list if it is one

  // They return one value; the default where there is none. A wrong count throws Error.
  double number(std::string_view name, double otherwise);
  int integer(std::string_view name, int otherwise);
  bool boolean(std::string_view name, bool otherwise);
  std::string text(std::string_view name, const std::string& otherwise);
  std::optional<std::array<double, 3>> triple(std::string_view name);

  // Marks parameters that change nothing in the picture as used.
  void ignore(std::initializer_list<std::string_view> names);
  // Adds a diagnostic for each parameter that was neither used nor ignored.
  void report_unused(Report& report) const;

  const std::string& owner() const { return owner_; }
  const Place& place() const { return place_; }
  const std::vector<Parameter>& all() const { return parameters_; }

 private:
  Parameter* find_as_it_is(std::string_view name, std::initializer_list<ParameterType> types);

  std::string owner_;
  Place place_;
  std::vector<Parameter> parameters_;
  std::vector<std::string> asked_;
};

}  // namespace vitrail::pbrt
