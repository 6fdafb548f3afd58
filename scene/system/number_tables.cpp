// SPDX-License-Identifier: Apache-2.0
#include "scene/system/number_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vitrail {

namespace {

struct Line {
  std::string_view text;
  int number;  // from 1
  const std::string& file;

  [[noreturn]] void fail(const std::string& message, const char* at) const {
    throw Error(message, {file, number, static_cast<int>(at - text.data()) + 1}, std::string(text));
  }
};

template <class Number>
void add_row(const Line& line, NumberTable<Number>& table) {
  const char *at = line.text.data(), *end = at + line.text.size();
  std::size_t columns = 0;
  for (;; ++at) {
    Number value{};
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (rest != end && *rest != ' ') || !std::isfinite(value))
      line.fail("expected a number", at);
    table.values.push_back(value);
    ++columns;
    at = rest;
    if (at == end) break;
  }
  if (table.columns == 0) table.columns = columns;
  if (table.columns != columns)
    line.fail(fmt::format("a row of the table {} has {} numbers, not {}", table.name, columns, table.columns),
              line.text.data());
}

}  // namespace

template <class Number>
std::vector<NumberTable<Number>> number_tables(std::string_view text, const std::string& file) {
  std::vector<NumberTable<Number>> tables;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const Line line{text.substr(0, length), number, file};
    text.remove_prefix(std::min(length + 1, text.size()));
    if (line.text.empty() || line.text.front() == '#') continue;
    if (line.text.front() == '[') {
      if (line.text.size() < 3 || line.text.back() != ']') line.fail("expected [name]", line.text.data());
      tables.push_back({line.text.substr(1, line.text.size() - 2), 0, {}});
      continue;
    }
    if (tables.empty()) line.fail("expected [name] before the first row", line.text.data());
    add_row(line, tables.back());
  }
  for (const NumberTable<Number>& table : tables)
    if (table.values.empty()) throw Error(fmt::format("the table {} has no row", table.name), {file, 0, 0});
  return tables;
}

template <class Number>
const NumberTable<Number>& find_table(const std::vector<NumberTable<Number>>& tables, std::string_view name,
                                      std::size_t columns) {
  const auto found = std::ranges::find(tables, name, &NumberTable<Number>::name);
  if (found == tables.end()) throw Error(fmt::format("there is no table {}", name));
  if (found->columns != columns)
    throw Error(fmt::format("the table {} has {} columns, not {}", name, found->columns, columns));
  return *found;
}

template std::vector<NumberTable<float>> number_tables(std::string_view, const std::string&);
template std::vector<NumberTable<double>> number_tables(std::string_view, const std::string&);
template const NumberTable<float>& find_table(const std::vector<NumberTable<float>>&, std::string_view,
                                              std::size_t);
template const NumberTable<double>& find_table(const std::vector<NumberTable<double>>&, std::string_view,
                                               std::size_t);

}  // namespace vitrail
