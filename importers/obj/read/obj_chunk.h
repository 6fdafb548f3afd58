// SPDX-License-Identifier: Apache-2.0
// Threads read pieces of an OBJ file by themselves: nothing in a piece depends on what comes before.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/geometry/vec.h"

namespace vitrail::obj {

// It is a face whose corners all have the same kinds of index.
struct ChunkFace {
  std::uint32_t offset;   // of its line in the chunk, in bytes
  std::uint32_t line;     // in the chunk, from 0
  std::uint32_t indices;  // where its first is in the chunk's
  std::uint16_t corners;
  bool has_uvs : 1, has_normals : 1;
  bool is_relative : 1;  // indices count from the beginning of the segment, from 0; else as they are in the
                         // file
};

// It has vertices, then faces, then lines of anything else, which only the statement reader understands.
struct Segment {
  std::size_t positions = 0, uvs = 0, normals = 0, faces = 0;  // where they end in the chunk's
  std::size_t rare_begin = 0, rare_end = 0;                    // bytes of the chunk
  std::uint32_t rare_line = 0, rare_lines = 0;
};

struct Chunk {
  const char* begin = nullptr;
  const char* end = nullptr;
  std::vector<Point3f> positions;
  std::vector<Point2f> uvs;
  std::vector<Normal3f> normals;
  std::vector<std::int32_t> indices;  // of a corner: position, uv and normal where the face has them
  std::vector<ChunkFace> faces;
  std::vector<Segment> segments;
  Bounds3d bounds;  // of the positions, before the offset is subtracted
  std::uint32_t lines = 0;
};

// Returns where a chunk that begins at `begin` ends: after the first line beyond `size` bytes that no
// backslash joins with the next one; `end` if there is none.
const char* chunk_end(const char* begin, const char* end, std::size_t size);

// Reads the text from chunk.begin to chunk.end and replaces the rest of the record. Lines that are not plain
// and correct v, vt, vn, f or comments are left to the statement reader, errors among them.
void read_chunk(Chunk& chunk, Vector3d offset);

}  // namespace vitrail::obj
