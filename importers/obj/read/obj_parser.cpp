// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/obj_parser.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <tuple>

#include "importers/obj/read/obj_chunk.h"
#include "importers/obj/read/obj_statements.h"

namespace vitrail::obj {

namespace {

// Joins chunks in their order.
class Merger {
 public:
  Merger(const std::string& file, const ParseOptions& options, Geometry& geometry)
      : base_(options.base), geometry_(geometry), statements_(file, options, geometry) {}

  void add(const Chunk& chunk) {
    if (!chunk.bounds.empty()) extend(geometry_.bounds, chunk.bounds);
    Segment done;
    for (const Segment& segment : chunk.segments) {
      if (statements_.counts_from_zero()) return;
      add_segment(chunk, done, segment);
      done = segment;
    }
    line_ += static_cast<int>(chunk.lines);
  }

  bool counts_from_zero() const { return statements_.counts_from_zero(); }
  void finish() { statements_.finish(); }

 private:
  void add_segment(const Chunk& chunk, const Segment& done, const Segment& segment) {
    const std::array<std::size_t, 3> before{geometry_.positions.size(), geometry_.uvs.size(),
                                            geometry_.normals.size()};
    geometry_.positions.append(
        std::span(chunk.positions).subspan(done.positions, segment.positions - done.positions));
    geometry_.uvs.append(std::span(chunk.uvs).subspan(done.uvs, segment.uvs - done.uvs));
    geometry_.normals.append(std::span(chunk.normals).subspan(done.normals, segment.normals - done.normals));
    for (std::size_t i = done.faces; i != segment.faces; ++i) {
      const ChunkFace& face = chunk.faces[i];
      if (!add_face(chunk, face, before)) {
        const char* const begin = chunk.begin + face.offset;
        const char* const end = std::find(begin, chunk.end, '\n');
        statements_.read(begin, end, line_ + static_cast<int>(face.line));
      }
    }
    if (segment.rare_begin == segment.rare_end) return;
    const int first = line_ + static_cast<int>(segment.rare_line);
    const int last =
        statements_.read(chunk.begin + segment.rare_begin, chunk.begin + segment.rare_end, first);
    // Lines may end with carriage returns alone, which chunks do not count.
    line_ += last - first - static_cast<int>(segment.rare_lines);
  }

  // False where an index is not one of what has been read.
  bool add_face(const Chunk& chunk, const ChunkFace& face, const std::array<std::size_t, 3>& before) {
    corners_.resize(face.corners);
    const std::int32_t* index = &chunk.indices[face.indices];
    const std::array<std::size_t, 3> counts{geometry_.positions.size(), geometry_.uvs.size(),
                                            geometry_.normals.size()};
    bool valid = true;
    const auto resolve = [&](std::size_t kind) {
      const std::int64_t raw = *index++;
      const std::int64_t i = face.is_relative ? raw + static_cast<std::int64_t>(before[kind]) : raw - base_;
      valid &= static_cast<std::uint64_t>(i) < counts[kind] && (face.is_relative || raw > 0);
      return static_cast<std::uint32_t>(i);
    };
    for (Corner& corner : corners_) {
      corner.position = resolve(0);
      if (face.has_uvs) corner.uv = resolve(1);
      if (face.has_normals) corner.normal = resolve(2);
    }
    if (valid)
      statements_.faces().add(corners_, statements_.use(), face.has_uvs, face.has_normals,
                              statements_.smoothing_group());
    return valid;
  }

  int base_;
  Geometry& geometry_;
  StatementReader statements_;
  int line_ = 1;  // where the chunk begins, less the line ends that are in it but not counted there
  std::vector<Corner> corners_;
};

constexpr std::size_t chunk_bytes = std::size_t{256} << 10;
constexpr std::size_t chunks_at_once = 8;

// Chunks are read by any thread and joined in their order.
void parse_in_parallel(InputBytes& bytes, Vector3d offset, Merger& merger) {
  std::array<Chunk, chunks_at_once> chunks;  // used in turn: no more are alive
  std::size_t count = 0;
  const char* at = after_byte_order_mark(bytes.begin(), bytes.end());
  std::atomic<bool> stopped = false;
  const auto cut = [&](tbb::flow_control& control) -> Chunk* {
    if (at == bytes.end() || stopped) {
      control.stop();
      return nullptr;
    }
    Chunk& chunk = chunks[count++ % chunks_at_once];
    chunk.begin = at;
    chunk.end = at = chunk_end(at, bytes.end(), chunk_bytes);
    return &chunk;
  };
  const auto read = [&](Chunk* chunk) {
    read_chunk(*chunk, offset);
    return chunk;
  };
  const auto join = [&](const Chunk* chunk) {
    merger.add(*chunk);
    if (merger.counts_from_zero()) stopped = true;
    bytes.release_before(chunk->end);
  };
  constexpr auto in_order = tbb::filter_mode::serial_in_order;
  tbb::parallel_pipeline(chunks_at_once,
                         tbb::make_filter<void, Chunk*>(in_order, cut) &
                             tbb::make_filter<Chunk*, Chunk*>(tbb::filter_mode::parallel, read) &
                             tbb::make_filter<Chunk*, void>(in_order, join));
}

// So triangles come in the order that they have without objects, where the file has an object at a time.
void order_by_material(std::vector<Group>& groups) {
  const auto kind = [](const Group& g) {
    return std::tuple(g.material, g.has_uvs, g.has_normals, g.is_smooth);
  };
  std::map<decltype(kind(groups[0])), std::size_t> places;
  for (const Group& group : groups) places.try_emplace(kind(group), places.size());
  std::ranges::stable_sort(groups, {}, [&](const Group& group) { return places.at(kind(group)); });
}

}  // namespace

std::string name_of(const Object& object, const Geometry& geometry) {
  const bool by_o = object.g.empty() || (geometry.several_named && !object.o.empty());
  return by_o ? object.o : object.g;
}

std::optional<Geometry> parse(InputBytes& bytes, const std::string& file, const ParseOptions& options) {
  Geometry geometry;
  Merger merger(file, options, geometry);
  if (bytes.size() > chunk_bytes) {
    parse_in_parallel(bytes, options.offset, merger);
  } else {
    Chunk chunk;
    chunk.begin = after_byte_order_mark(bytes.begin(), bytes.end());
    chunk.end = bytes.end();
    read_chunk(chunk, options.offset);
    merger.add(chunk);
  }
  if (!merger.counts_from_zero()) merger.finish();
  if (merger.counts_from_zero()) return {};
  order_by_material(geometry.groups);
  return geometry;
}

}  // namespace vitrail::obj
