// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/ply_body.h"

#include "importers/ply/ply_source.h"
#include "importers/shapes/polygon.h"

namespace vitrail::ply {

namespace {

constexpr std::size_t chunk_rows = 1024;

template <class Source, class OnScalar, class OnList>
void read_rows(Source& source, const Element& element, OnScalar&& on_scalar, OnList&& on_list) {
  std::vector<double> items;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (!property.count_type) {
        on_scalar(i, source.number(element, property));
        continue;
      }
      const std::uint64_t length = source.list_length(element, property);
      items.clear();
      for (std::uint64_t k = 0; k < length; ++k) items.push_back(source.number(element, property));
      on_list(i, items);
    }
    if (row % chunk_rows == 0) source.release_read();
  }
}

template <class Source>
void skip_element(Source& source, const Element& element) {
  source.require_room(element);
  if (element.properties.empty()) return;
  if constexpr (Source::binary) {
    if (!element.has_list()) return source.skip(element.count * element.row_size());
  }
  read_rows(
      source, element, [](std::size_t, double) {}, [](std::size_t, const std::vector<double>&) {});
}

// ---- Vertices -----------------------------------------------------------------------------------

// Rows of floats on their way into a mesh: slots 0–2 position, 3–5 normal, 6–7 uv.
struct VertexChunk {
  std::array<float, 3 * chunk_rows> positions, normals;
  std::array<float, 2 * chunk_rows> uvs;

  struct Column {
    float* first;
    std::size_t stride;
  };
  Column column(std::size_t slot) {
    if (slot < 3) return {positions.data() + slot, 3};
    if (slot < 6) return {normals.data() + (slot - 3), 3};
    return {uvs.data() + (slot - 6), 2};
  }
};

template <class T>
void append(std::vector<T>& to, const float* from, std::size_t count) {
  static_assert(sizeof(T) % sizeof(float) == 0 && std::is_trivially_copyable_v<T>);
  const std::size_t before = to.size();
  to.resize(before + count);
  std::memcpy(static_cast<void*>(to.data() + before), from, count * sizeof(T));
}

void append(TriangleMesh& mesh, const VertexLayout& layout, const VertexChunk& chunk, std::size_t count) {
  append(mesh.positions, chunk.positions.data(), count);
  if (layout.has_normals()) append(mesh.normals, chunk.normals.data(), count);
  if (layout.has_uvs()) append(mesh.uvs, chunk.uvs.data(), count);
}

template <class T, bool swapped>
void load_column(const char* from, std::size_t row_size, std::size_t count, VertexChunk::Column to) {
  for (std::size_t i = 0; i < count; ++i) {
    to.first[i * to.stride] = static_cast<float>(load<T, swapped>(from + i * row_size));
  }
}

bool all_finite(VertexChunk::Column column, std::size_t count) {
  bool finite = true;
  for (std::size_t i = 0; i < count; ++i) finite &= std::isfinite(column.first[i * column.stride]);
  return finite;
}

std::string not_finite(const Property& property, std::uint64_t row) {
  return fmt::format("{} of vertex {} is not a finite single-precision number", property.name, row);
}

// Rows of a fixed size: a column at a time, in chunks that stay in the cache.
template <class Source>
void read_vertex_columns(Source& source, const Element& element, const VertexLayout& layout,
                         TriangleMesh& mesh) {
  std::vector<std::size_t> offsets;
  std::size_t row_size = 0;
  for (const Property& p : element.properties) {
    offsets.push_back(row_size);
    row_size += size_of(p.type);
  }
  VertexChunk chunk;
  for (std::uint64_t row = 0; row < element.count; row += chunk_rows) {
    const std::size_t count = std::min<std::uint64_t>(chunk_rows, element.count - row);
    for (std::size_t slot = 0; slot < VertexLayout::slots; ++slot) {
      if (!layout.property[slot]) continue;
      const std::size_t i = *layout.property[slot];
      const Property& property = element.properties[i];
      const char* const from = source.at() + offsets[i];
      const auto column = chunk.column(slot);
      with_type(property.type,
                [&](auto t) { load_column<decltype(t), Source::swapped>(from, row_size, count, column); });
      if (all_finite(column, count)) continue;
      std::size_t bad = 0;
      while (std::isfinite(column.first[bad * column.stride])) ++bad;
      source.fail(element, not_finite(property, row + bad), from + bad * row_size);
    }
    append(mesh, layout, chunk, count);
    source.skip(count * row_size);
    source.release_read();
  }
}

template <class Source>
void read_vertex_rows(Source& source, const Element& element, const VertexLayout& layout,
                      TriangleMesh& mesh) {
  std::vector<std::optional<std::size_t>> slot_of(element.properties.size());
  for (std::size_t slot = 0; slot < VertexLayout::slots; ++slot) {
    if (layout.property[slot]) slot_of[*layout.property[slot]] = slot;
  }
  VertexChunk row;
  const auto last_property = element.properties.size() - 1;
  const auto end_row = [&](std::size_t i) {
    if (i == last_property) append(mesh, layout, row, 1);
  };
  read_rows(
      source, element,
      [&](std::size_t i, double value) {
        if (const auto slot = slot_of[i]) {
          *row.column(*slot).first = static_cast<float>(value);
          if (!std::isfinite(static_cast<float>(value))) {
            source.fail(element, not_finite(element.properties[i], mesh.positions.size()));
          }
        }
        end_row(i);
      },
      [&](std::size_t i, const std::vector<double>&) { end_row(i); });
}

template <class Source>
void read_vertices(Source& source, const Element& element, const VertexLayout& layout, TriangleMesh& mesh) {
  source.require_room(element);
  if (element.count > std::numeric_limits<std::uint32_t>::max()) {
    throw Error("more vertices than 32 bits count; split the mesh", element.location, element.excerpt);
  }
  mesh.positions.reserve(element.count);
  if (layout.has_normals()) mesh.normals.reserve(element.count);
  if (layout.has_uvs()) mesh.uvs.reserve(element.count);
  if constexpr (Source::binary) {
    if (!element.has_list()) return read_vertex_columns(source, element, layout, mesh);
  }
  read_vertex_rows(source, element, layout, mesh);
}

// ---- Faces --------------------------------------------------------------------------------------

// Takes corners that are in range.
class FaceSink {
 public:
  explicit FaceSink(Body& body) : body_(body) {}

  void add(std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) {
      body_.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() < 3) {
      ++body_.dropped_faces;
    } else {
      add_polygon(corners);
    }
  }

 private:
  void add_polygon(std::span<const std::uint32_t> corners) {
    points_.clear();
    cut_.clear();
    for (const std::uint32_t i : corners) points_.push_back(cast<double>(body_.mesh.positions[i]));
    triangulate_polygon(points_, cut_);
    for (const auto& [a, b, c] : cut_) body_.mesh.triangles.push_back({corners[a], corners[b], corners[c]});
  }

  Body& body_;
  std::vector<Point3d> points_;
  std::vector<CornerTriple> cut_;
};

std::string out_of_range(double index, std::size_t vertices) {
  return fmt::format("vertex index {} is out of range: there are {} vertices, counted from 0", index,
                     vertices);
}

// One list of 32-bit indices with its length in a byte, scalars before and after it: what nearly all files
// have.
template <class Source>
void read_common_faces(Source& source, const Element& element, std::size_t list, Body& body) {
  std::size_t before = 0, after = 0;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (i != list) (i < list ? before : after) += size_of(element.properties[i].type);
  }
  const auto vertices = static_cast<std::uint32_t>(body.mesh.positions.size());
  FaceSink sink(body);
  std::vector<std::uint32_t> corners(255);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    const char* const at = source.at() + before;
    const auto truncated = [&] {
      source.fail(element, fmt::format("the file ends within face {}", row), source.at());
    };
    if (source.left() < before + 1) truncated();
    const std::size_t length = static_cast<unsigned char>(*at);
    if (source.left() < before + 1 + 4 * length + after) truncated();
    std::uint32_t greatest = 0;
    for (std::size_t k = 0; k < length; ++k) {
      // A negative index becomes a huge one.
      corners[k] = load<std::uint32_t, Source::swapped>(at + 1 + 4 * k);
      greatest = std::max(greatest, corners[k]);
    }
    if (length > 0 && greatest >= vertices) {
      const bool is_signed = element.properties[list].type == Type::int32;
      const double index = is_signed ? static_cast<double>(static_cast<std::int32_t>(greatest)) : greatest;
      source.fail(element, out_of_range(index, vertices), at);
    }
    sink.add({corners.data(), length});
    source.skip(before + 1 + 4 * length + after);
    if (row % chunk_rows == 0) source.release_read();
  }
}

template <class Source>
void read_face_rows(Source& source, const Element& element, std::size_t list, Body& body) {
  const std::size_t vertices = body.mesh.positions.size();
  FaceSink sink(body);
  std::vector<std::uint32_t> corners;
  read_rows(
      source, element, [](std::size_t, double) {},
      [&](std::size_t i, const std::vector<double>& items) {
        if (i != list) return;
        corners.clear();
        for (const double index : items) {
          if (!(index >= 0 && index < static_cast<double>(vertices)) || index != std::floor(index)) {
            source.fail(element, out_of_range(index, vertices));
          }
          corners.push_back(static_cast<std::uint32_t>(index));
        }
        sink.add(corners);
      });
}

template <class Source>
void read_faces(Source& source, const Element& element, std::size_t list, Body& body) {
  source.require_room(element);
  // As many as there could be triangles, each with three indices.
  const Property& corners = element.properties[list];
  const std::size_t least = Source::binary ? element.row_size() + 3 * size_of(corners.type) : 8;
  body.mesh.triangles.reserve(std::min<std::uint64_t>(element.count, source.left() / least + 1));
  if constexpr (Source::binary) {
    const auto lists =
        std::ranges::count_if(element.properties, [](const Property& p) { return p.count_type.has_value(); });
    const bool words = corners.type == Type::int32 || corners.type == Type::uint32;
    if (lists == 1 && words && size_of(*corners.count_type) == 1) {
      return read_common_faces(source, element, list, body);
    }
  }
  read_face_rows(source, element, list, body);
}

template <class Source>
Body read(Source source, const Header& header, const BodyPlan& plan) {
  Body body;
  std::optional<Source> faces;  // where they begin, if before the vertices
  for (std::size_t i = 0; i <= std::max(plan.vertex_element, plan.face_element); ++i) {
    const Element& element = header.elements[i];
    if (i == plan.vertex_element) {
      read_vertices(source, element, plan.vertex, body.mesh);
    } else if (i == plan.face_element && i > plan.vertex_element) {
      read_faces(source, element, plan.corner_list, body);
    } else {
      if (i == plan.face_element) faces = source;
      skip_element(source, element);
    }
  }
  if (faces) read_faces(*faces, header.elements[plan.face_element], plan.corner_list, body);
  return body;
}

}  // namespace

Body read_body(InputBytes& bytes, const TextCursor& cursor, const Header& header, const BodyPlan& plan) {
  switch (header.format) {
    case Format::ascii:
      return read(AsciiSource(bytes, cursor), header, plan);
    case Format::binary_big_endian:
      return read(BinarySource<true>(bytes, cursor), header, plan);
    default:
      return read(BinarySource<false>(bytes, cursor), header, plan);
  }
}

}  // namespace vitrail::ply
