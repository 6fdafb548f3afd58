// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace vitrail::ply {

namespace {

constexpr std::array<std::pair<std::string_view, Type>, 16> type_names{{
    {"char", Type::int8},
    {"int8", Type::int8},
    {"uchar", Type::uint8},
    {"uint8", Type::uint8},
    {"short", Type::int16},
    {"int16", Type::int16},
    {"ushort", Type::uint16},
    {"uint16", Type::uint16},
    {"int", Type::int32},
    {"int32", Type::int32},
    {"uint", Type::uint32},
    {"uint32", Type::uint32},
    {"float", Type::float32},
    {"float32", Type::float32},
    {"double", Type::float64},
    {"float64", Type::float64},
}};

Type read_type(TextCursor& cursor) {
  const std::string_view word = cursor.word();
  for (const auto& [name, type] : type_names) {
    if (word == name) return type;
  }
  cursor.fail(
      fmt::format(
          "unknown type '{}'; a PLY type is one of char, uchar, short, ushort, int, uint, float, double",
          printable(word)),
      cursor.at() - word.size());
}

std::string read_name(TextCursor& cursor, const char* what) {
  const std::string_view word = cursor.word();
  if (word.empty()) cursor.fail(fmt::format("{} is missing", what));
  return printable(word, 200);
}

Format read_format(TextCursor& cursor) {
  const std::string_view word = cursor.word();
  const std::string_view version = cursor.word();
  if (version != "1.0")
    cursor.fail(fmt::format("unknown PLY version '{}'; only 1.0 exists", printable(version)));
  if (word == "ascii") return Format::ascii;
  if (word == "binary_little_endian") return Format::binary_little_endian;
  if (word == "binary_big_endian") return Format::binary_big_endian;
  cursor.fail(fmt::format("unknown format '{}'; expected ascii, binary_little_endian or binary_big_endian",
                          printable(word)));
}

Element read_element(TextCursor& cursor, const Header& header) {
  Element element;
  element.name = read_name(cursor, "the element's name");
  if (std::ranges::any_of(header.elements, [&](const Element& e) { return e.name == element.name; })) {
    cursor.fail(fmt::format("element {} is declared twice", element.name));
  }
  const std::int64_t count = cursor.integer("the element's count");
  if (count < 0) cursor.fail(fmt::format("element {} has a negative count", element.name));
  element.count = static_cast<std::uint64_t>(count);
  element.location = cursor.location();
  element.location.column = 1;
  element.excerpt = fmt::format("element {} {}", element.name, element.count);
  return element;
}

void read_property(TextCursor& cursor, Header& header) {
  if (header.elements.empty()) cursor.fail("a property before any element");
  std::vector<Property>& properties = header.elements.back().properties;
  Property property;
  TextCursor ahead = cursor;
  if (ahead.word() == "list") {
    cursor = ahead;
    property.count_type = read_type(cursor);
    if (!is_integer(*property.count_type)) cursor.fail("the length of a list has to be of an integer type");
  }
  property.type = read_type(cursor);
  property.name = read_name(cursor, "the property's name");
  property.location = cursor.location();
  property.location.column = 1;
  if (std::ranges::any_of(properties, [&](const Property& p) { return p.name == property.name; })) {
    cursor.fail(fmt::format("property {} is declared twice", property.name));
  }
  properties.push_back(std::move(property));
}

void read_comment(TextCursor& cursor, Header& header) {
  TextCursor ahead = cursor;
  if (ahead.word() == "TextureFile") header.texture_files.emplace_back(ahead.rest_of_line());
  cursor.rest_of_line();
}

// The body of a binary file may begin with any byte: a line feed after a lone carriage return belongs to it
// if the lines of this header end with carriage returns alone.
void end_header(TextCursor& cursor, Format format, bool returns_alone) {
  if (!cursor.at_line_end()) cursor.fail("unexpected text after end_header");
  if (format != Format::ascii && returns_alone) {
    cursor.accept('\r');
  } else {
    cursor.skip_line();
  }
}

}  // namespace

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

bool is_integer(Type type) { return type < Type::float32; }

std::size_t Element::row_size() const {
  std::size_t size = 0;
  for (const Property& p : properties) size += size_of(p.count_type.value_or(p.type));
  return size;
}

bool Element::has_list() const {
  return std::ranges::any_of(properties, [](const Property& p) { return p.count_type.has_value(); });
}

Header read_header(TextCursor& cursor) {
  if (cursor.word() != "ply" || !cursor.at_line_end())
    cursor.fail("not a PLY file: it does not begin with 'ply'");
  const bool returns_alone =
      cursor.end() - cursor.at() >= 2 && cursor.at()[0] == '\r' && cursor.at()[1] != '\n';
  Header header;
  bool has_format = false;
  while (cursor.skip_to_text()) {
    const std::string_view word = cursor.word();
    if (word == "end_header") {
      if (!has_format) cursor.fail("the header has no format line");
      end_header(cursor, header.format, returns_alone);
      return header;
    }
    if (word == "comment" || word == "obj_info") {
      read_comment(cursor, header);
      continue;
    }
    if (word == "format") {
      header.format = read_format(cursor);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(cursor, header));
    } else if (word == "property") {
      read_property(cursor, header);
    } else {
      cursor.fail(fmt::format("unknown word '{}' in the header", printable(word)), cursor.at() - word.size());
    }
    if (!cursor.at_line_end()) cursor.fail("unexpected text at the end of the line");
  }
  cursor.fail("the header has no end_header line");
}

}  // namespace vitrail::ply
