// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_chunk.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "importers/bytes/plain_decimal.h"

namespace vitrail::obj {

namespace {

const char* after_line(const char* at, const char* end) {
  const void* const found = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
  return found ? static_cast<const char*>(found) + 1 : end;
}

// After the line of `at` and those which backslashes join with it, in a text that begins at `begin`.
const char* after_joined_lines(const char* at, const char* begin, const char* end) {
  for (;;) {
    at = after_line(at, end);
    const char* last = at - 1;  // the line feed
    if (last > begin && last[-1] == '\r') --last;
    if (at == end || last == begin || last[-1] != '\\') return at;
  }
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// All functions that take a place return the one after what they have read, or nullptr where it is not plain.
// Lines end with a line feed within the chunk, so they stop there by themselves.
class ChunkReader {
 public:
  ChunkReader(Chunk& chunk, Vector3d offset) : chunk_(chunk), end_(chunk.end), offset_(offset) {}

  void read() {
    for (const char* at = chunk_.begin; at != end_;) {
      line_begin_ = at;
      const char* const next = plain_statement(at);
      at = next ? next : leave_to_statement_reader(at);
      chunk_.lines += next ? 1 : 0;
    }
    close_segment();
  }

 private:
  const char* plain_statement(const char* at) {
    if (end_[-1] != '\n' && after_line(at, end_) == end_) return nullptr;  // the last line of a file
    at = skip_blanks(at);
    switch (*at) {
      case 'v':
        return vertex(at + 1);
      case 'f':
        return is_blank(at[1]) ? face(at + 2) : nullptr;
      case '#':
        return comment(at);
      default:
        return line_end(at);
    }
  }

  const char* vertex(const char* at) {
    if (open_.faces != chunk_.faces.size()) close_segment();
    if (is_blank(*at)) return position(at);
    if (*at == 't' && is_blank(at[1])) return uv(at + 1);
    if (*at == 'n' && is_blank(at[1])) return normal(at + 1);
    return nullptr;
  }

  const char* position(const char* at) {
    Point3d p;
    if (!(at = number(at, p.x)) || !(at = number(at, p.y)) || !(at = number(at, p.z))) return nullptr;
    if (!(at = line_end(at))) return nullptr;
    extend(chunk_.bounds, p);
    chunk_.positions.push_back(cast<float>(p - offset_));
    return at;
  }

  const char* uv(const char* at) {
    double u = 0, v = 0, third = 0;
    if (!(at = number(at, u)) || !(at = number(at, v))) return nullptr;
    const char* const stop = line_end(at);
    if (!stop && (!(at = number(at, third)) || !(at = line_end(at)))) return nullptr;
    chunk_.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    return stop ? stop : at;
  }

  const char* normal(const char* at) {
    double x = 0, y = 0, z = 0;
    if (!(at = number(at, x)) || !(at = number(at, y)) || !(at = number(at, z))) return nullptr;
    if (!(at = line_end(at))) return nullptr;
    chunk_.normals.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    return at;
  }

  // ---- Faces ------------------------------------------------------------------------------------

  const char* face(const char* at) {
    ChunkFace face{static_cast<std::uint32_t>(line_begin_ - chunk_.begin),
                   chunk_.lines,
                   static_cast<std::uint32_t>(chunk_.indices.size()),
                   0,
                   false,
                   false,
                   false};
    const char* const stop = corners(at, face);
    if (stop) {
      chunk_.faces.push_back(face);
    } else {
      chunk_.indices.resize(face.indices);
    }
    return stop;
  }

  const char* corners(const char* at, ChunkFace& face) {
    at = skip_blanks(at);
    face.is_relative = *at == '-';
    for (std::uint32_t count = 0;; ++count) {
      if (const char* const stop = line_end(at)) {
        face.corners = static_cast<std::uint16_t>(count);
        return count >= 3 && count <= std::numeric_limits<std::uint16_t>::max() ? stop : nullptr;
      }
      bool has_uv = false, has_normal = false;
      at = corner(skip_blanks(at), face.is_relative, has_uv, has_normal);
      if (!at) return nullptr;
      if (count == 0) {
        face.has_uvs = has_uv;
        face.has_normals = has_normal;
      }
      if (has_uv != face.has_uvs || has_normal != face.has_normals) return nullptr;
    }
  }

  const char* corner(const char* at, bool relative, bool& has_uv, bool& has_normal) {
    at = index(at, relative, chunk_.positions.size() - open_begin_.positions);
    if (!at || *at != '/') return at;
    ++at;
    if (*at != '/') {
      has_uv = true;
      at = index(at, relative, chunk_.uvs.size() - open_begin_.uvs);
      if (!at || *at != '/') return at;
    }
    has_normal = true;
    return index(at + 1, relative, chunk_.normals.size() - open_begin_.normals);
  }

  const char* index(const char* at, bool relative, std::size_t count) {
    constexpr std::ptrdiff_t most_digits = 9;
    if (relative && *at++ != '-') return nullptr;
    const char* const begin = at;
    std::int32_t value = 0;
    for (; is_digit(*at) && at - begin < most_digits; ++at) value = 10 * value + (*at - '0');
    if (at == begin || is_digit(*at) || (relative && value == 0)) return nullptr;
    chunk_.indices.push_back(relative ? static_cast<std::int32_t>(count) - value : value);
    return at;
  }

  // ---- Text -------------------------------------------------------------------------------------

  static const char* skip_blanks(const char* at) {
    while (is_blank(*at)) ++at;
    return at;
  }

  // Skips blanks and the end of the line.
  static const char* line_end(const char* at) {
    at = skip_blanks(at);
    if (*at == '\r') ++at;
    return *at == '\n' ? at + 1 : nullptr;
  }

  const char* comment(const char* at) const {
    const char* const next = after_line(at, end_);
    const void* const other_end = std::memchr(at, '\r', static_cast<std::size_t>(next - at));
    return !other_end || other_end == next - 2 ? next : nullptr;
  }

  const char* number(const char* at, double& value) const {
    at = skip_blanks(at);
    const char* stop = plain_decimal(at, end_, value);
    if (!stop) {
      const auto parsed = fast_float::from_chars(at, end_, value);
      if (parsed.ec != std::errc{}) return nullptr;
      stop = parsed.ptr;
    }
    if (!(std::abs(value) <= std::numeric_limits<float>::max())) return nullptr;
    return is_blank(*stop) || *stop == '\n' || *stop == '\r' ? stop : nullptr;
  }

  // ---- Segments ---------------------------------------------------------------------------------

  void close_segment() {
    open_.positions = chunk_.positions.size();
    open_.uvs = chunk_.uvs.size();
    open_.normals = chunk_.normals.size();
    open_.faces = chunk_.faces.size();
    chunk_.segments.push_back(open_);
    open_.rare_begin = open_.rare_end = 0;
    open_begin_ = open_;
  }

  const char* leave_to_statement_reader(const char* at) {
    const char* const stop = after_joined_lines(at, chunk_.begin, end_);
    open_.rare_begin = static_cast<std::size_t>(at - chunk_.begin);
    open_.rare_end = static_cast<std::size_t>(stop - chunk_.begin);
    open_.rare_line = chunk_.lines;
    open_.rare_lines = static_cast<std::uint32_t>(std::count(at, stop, '\n'));
    chunk_.lines += open_.rare_lines;
    close_segment();
    return stop;
  }

  Chunk& chunk_;
  const char* end_;
  Vector3d offset_;
  const char* line_begin_ = nullptr;
  Segment open_, open_begin_;
};

}  // namespace

const char* chunk_end(const char* begin, const char* end, std::size_t size) {
  if (static_cast<std::size_t>(end - begin) <= size) return end;
  return after_joined_lines(begin + size, begin, end);
}

void read_chunk(Chunk& chunk, Vector3d offset) {
  chunk.positions.clear();
  chunk.uvs.clear();
  chunk.normals.clear();
  chunk.indices.clear();
  chunk.faces.clear();
  chunk.segments.clear();
  chunk.bounds = {};
  chunk.lines = 0;
  ChunkReader(chunk, offset).read();
}

}  // namespace vitrail::obj
