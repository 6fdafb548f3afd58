// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file describes its body.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "importers/bytes/input_bytes.h"
#include "importers/bytes/text_cursor.h"

namespace vitrail::ply {

enum class Format { ascii, binary_little_endian, binary_big_endian };

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(Type type);
bool is_integer(Type type);

struct Property {
  std::string name;
  Type type = Type::float32;       // of the value, or of a list's items
  std::optional<Type> count_type;  // set for lists
  SourceLocation location;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  SourceLocation location;
  std::string excerpt;

  // Returns the bytes of a binary row; of the shortest one where there are lists.
  std::size_t row_size() const;
  bool has_list() const;
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  // They are images that comments name, as MeshLab writes them: "comment TextureFile wood.png".
  std::vector<std::string> texture_files;
};

// Reads up to the first byte of the body, where it leaves the cursor. Throws Error.
Header read_header(TextCursor& cursor);

}  // namespace vitrail::ply
