// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "importers/bytes/growing_array.h"
#include "importers/ply/read/ply_body.h"
#include "importers/ply/read/ply_rows.h"

namespace vitrail::ply {

// It has rows of floats on their way into a mesh: slots 0–2 position, 3–5 normal, 6–7 uv.
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

inline void append(TriangleMesh& mesh, const VertexLayout& layout, const VertexChunk& chunk,
                   std::size_t count) {
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

// Loads `width` columns side by side.
template <std::size_t width, bool swapped>
void load_floats(const char* from, std::size_t row_size, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i, from += row_size, to += width) {
    for (std::size_t k = 0; k < width; ++k) to[k] = load<float, swapped>(from + k * sizeof(float));
  }
}

template <std::size_t size>
bool all_finite(const std::array<float, size>& values, std::size_t count) {
  constexpr std::uint32_t exponent = 0x7f800000;
  bool finite = true;
  for (std::size_t i = 0; i < count; ++i) {
    finite &= (std::bit_cast<std::uint32_t>(values[i]) & exponent) != exponent;
  }
  return finite;
}

// Puts 0 in the place of numbers that are not finite. Returns how many there were.
template <std::size_t size>
std::uint64_t make_finite(std::array<float, size>& values, std::size_t count) {
  if (all_finite(values, count)) return 0;
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) values[i] = 0, ++lost;
  return lost;
}

inline std::string not_finite(const Property& property, std::uint64_t row) {
  return fmt::format("{} of vertex {} is not a finite single-precision number", property.name, row);
}

// It reads rows of a fixed size, in chunks that stay in the cache.
template <class Source>
class VertexColumns {
 public:
  VertexColumns(const Element& element, const VertexLayout& layout) : element_(element), layout_(layout) {
    for (const Property& p : element.properties) {
      offsets_.push_back(row_size_);
      row_size_ += size_of(p.type);
    }
  }

  // Returns how many numbers were not finite and are 0.
  std::uint64_t read(Source& source, TriangleMesh& mesh) {
    std::uint64_t lost = 0;
    for (std::uint64_t row = 0; row < element_.count; row += chunk_rows) {
      const std::size_t count = std::min<std::uint64_t>(chunk_rows, element_.count - row);
      load_group<3>(source.at(), 0, count, chunk_.positions);
      load_group<3>(source.at(), 3, count, chunk_.normals);
      load_group<2>(source.at(), 6, count, chunk_.uvs);
      if (!all_finite(chunk_.positions, 3 * count)) refuse(source, row, count);
      if (layout_.has_normals()) lost += make_finite(chunk_.normals, 3 * count);
      if (layout_.has_uvs()) lost += make_finite(chunk_.uvs, 2 * count);
      append(mesh, layout_, chunk_, count);
      source.skip(count * row_size_);
      source.release_read();
    }
    return lost;
  }

 private:
  // Loads the slots from `first` on.
  template <std::size_t width, std::size_t size>
  void load_group(const char* from, std::size_t first, std::size_t count, std::array<float, size>& to) {
    if (!layout_.property[first]) return;
    bool side_by_side = true;
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t i = *layout_.property[first + k];
      side_by_side &= element_.properties[i].type == Type::float32 && i == *layout_.property[first] + k;
    }
    if (side_by_side) {
      return load_floats<width, Source::swapped>(from + offsets_[*layout_.property[first]], row_size_, count,
                                                 to.data());
    }
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t i = *layout_.property[first + k];
      with_type(element_.properties[i].type, [&](auto t) {
        load_column<decltype(t), Source::swapped>(from + offsets_[i], row_size_, count,
                                                  {to.data() + k, width});
      });
    }
  }

  // Fails by the first position of the chunk that is not finite.
  void refuse(const Source& source, std::uint64_t row, std::size_t count) {
    for (std::size_t slot = 0; slot < VertexLayout::first_normal; ++slot) {
      const auto column = chunk_.column(slot);
      const std::size_t i = *layout_.property[slot];
      for (std::size_t k = 0; k < count; ++k) {
        if (std::isfinite(column.first[k * column.stride])) continue;
        source.fail(element_, not_finite(element_.properties[i], row + k),
                    source.at() + offsets_[i] + k * row_size_);
      }
    }
  }

  const Element& element_;
  const VertexLayout& layout_;
  std::vector<std::size_t> offsets_;
  std::size_t row_size_ = 0;
  VertexChunk chunk_;
};

template <class Source>
std::uint64_t read_vertex_rows(Source& source, const Element& element, const VertexLayout& layout,
                               TriangleMesh& mesh) {
  std::uint64_t lost = 0;
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
          float& to = *row.column(*slot).first = static_cast<float>(value);
          if (!std::isfinite(to)) {
            if (*slot < VertexLayout::first_normal)
              source.fail(element, not_finite(element.properties[i], mesh.positions.size()));
            to = 0;
            ++lost;
          }
        }
        end_row(i);
      },
      [&](std::size_t i, const std::vector<double>&) { end_row(i); });
  return lost;
}

template <class T>
void reserve(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  prefer_huge_pages(values.data(), count);
}

template <class Source>
void prepare_vertices(const Source& source, const Element& element, const VertexLayout& layout,
                      TriangleMesh& mesh) {
  source.require_room(element);
  if (element.count > std::numeric_limits<std::uint32_t>::max()) {
    throw Error("more vertices than 32 bits count; split the mesh", element.location, element.excerpt);
  }
  reserve(mesh.positions, element.count);
  if (layout.has_normals()) reserve(mesh.normals, element.count);
  if (layout.has_uvs()) reserve(mesh.uvs, element.count);
}

// Reads positions, which have to be finite, normals and (u,v). Returns how many numbers of these two were
// not, and are 0.
template <class Source>
std::uint64_t read_vertices(Source& source, const Element& element, const VertexLayout& layout,
                            TriangleMesh& mesh) {
  if constexpr (Source::binary) {
    if (!element.has_list()) return VertexColumns<Source>(element, layout).read(source, mesh);
  }
  return read_vertex_rows(source, element, layout, mesh);
}

}  // namespace vitrail::ply
