// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/count_obj.h"

#include <algorithm>
#include <string_view>

#include "importers/bytes/input_bytes.h"

namespace vitrail {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\\'; }

constexpr std::size_t most_parts = 20'000;  // those beyond count as one with the last

bool begins_part(std::string_view line) {
  return line.starts_with("o ") || line.starts_with("g ") || line.starts_with("usemtl");
}

std::uint64_t count_words(const char* at, const char* end) {
  std::uint64_t words = 0;
  for (bool before = true; at != end; ++at) {
    const bool blank = is_blank(*at) || *at == '\n';
    if (before && !blank) ++words;
    before = blank;
  }
  return words;
}

}  // namespace

ObjCounts count_obj(const std::filesystem::path& file) {
  InputBytes bytes(file);
  ObjCounts counts;
  bool is_new_part = true;
  for (const char* line = bytes.begin(); line != bytes.end();) {
    const char* end = std::find(line, bytes.end(), '\n');
    while (end != bytes.end() && end != line && end[-1] == '\\') end = std::find(end + 1, bytes.end(), '\n');
    while (line != end && is_blank(*line)) ++line;
    if (end - line >= 2 && line[0] == 'v') {
      ++(line[1] == 't' ? counts.uvs : line[1] == 'n' ? counts.normals : counts.positions);
    } else if (end - line >= 2 && line[0] == 'f' && is_blank(line[1])) {
      const std::uint64_t corners = count_words(line + 1, end);
      counts.corners += corners;
      const std::uint64_t triangles = corners > 2 ? corners - 2 : 0;
      counts.triangles += triangles;
      if (is_new_part && triangles > 0 && counts.parts.size() < most_parts) counts.parts.push_back(0);
      if (triangles > 0) counts.parts.back() += triangles, is_new_part = false;
    } else if (begins_part(std::string_view(line, end))) {
      is_new_part = true;
    }
    line = end == bytes.end() ? end : end + 1;
    bytes.release_before(line);
  }
  return counts;
}

}  // namespace vitrail
