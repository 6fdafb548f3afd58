// SPDX-License-Identifier: Apache-2.0
// Reads the tables of numbers that stand in the source as text files (*_tables.txt) and that the build embeds
// in a library (vitrail_embed). A script of scripts/ writes each of these files and says so in its first
// lines.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/system/diagnostics.h"

namespace vitrail {

template <class Number>
struct NumberTable {
  std::string_view name;       // A part of the text that was read.
  std::size_t columns = 0;     // The count of numbers in each row, at least 1.
  std::vector<Number> values;  // [row][column], at least one row
};

// Returns the tables of a text in their order. A line "[name]" begins a table, and each further line is a row
// of it: numbers with one blank between them. Lines that are empty or begin with # are comments. A number is
// the float or the double nearest to its decimal digits. Throws Error, which names `file` and the line, where
// a line is none of these, a row is shorter or longer than the one before, or a table has no row.
template <class Number>
std::vector<NumberTable<Number>> number_tables(std::string_view text, const std::string& file);

// Returns the table of that name, which has so many columns. Throws Error where there is none such.
template <class Number>
const NumberTable<Number>& find_table(const std::vector<NumberTable<Number>>& tables, std::string_view name,
                                      std::size_t columns);

// Fills an array of arrays with the numbers of the table that find_table returns. Throws Error where it has
// fewer or more numbers than the array.
template <class Array, class Number>
void fill_from(const std::vector<NumberTable<Number>>& tables, std::string_view name, std::size_t columns,
               Array& array) {
  static_assert(std::is_trivially_copyable_v<Array>);
  const NumberTable<Number>& table = find_table(tables, name, columns);
  if (table.values.size() * sizeof(Number) != sizeof(Array))
    throw Error("the table " + std::string(name) + " has " + std::to_string(table.values.size()) +
                " numbers, not " + std::to_string(sizeof(Array) / sizeof(Number)));
  std::memcpy(&array, table.values.data(), sizeof(Array));
}

}  // namespace vitrail
