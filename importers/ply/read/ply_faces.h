// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "importers/ply/read/ply_vertices.h"
#include "importers/shapes/polygon.h"

namespace vitrail::ply {

// It takes corners that are in range.
class FaceSink {
 public:
  explicit FaceSink(Body& body) : body_(body) {}

  void add(std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) {
      body_.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() < 3) {
      ++body_.dropped_faces;
    } else if (corners.size() == 4 && body_.quads) {
      add_quad(corners[0], corners[1], corners[2], corners[3]);
    } else {
      body_.polygons += corners.size() > 4;
      add_polygon(corners);
    }
  }

 private:
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (*body_.quads == PbrtQuads::v4) {
      body_.patches.push_back({a, b, d, c});
    } else {
      body_.mesh.triangles.push_back({a, b, c});
      body_.mesh.triangles.push_back({d, a, c});
    }
  }

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

inline std::string out_of_range(double index, std::size_t vertices) {
  return fmt::format("vertex index {} is out of range: there are {} vertices, counted from 0", index,
                     vertices);
}

// It is one list of 32-bit indices with its length in a byte, with scalars before and after it. Nearly all
// files have this.
struct CommonFaces {
  std::size_t before = 0, after = 0;  // bytes of the scalars
  std::size_t triangle_row() const { return before + 1 + 3 * sizeof(std::uint32_t) + after; }
};

// Returns nothing if the element is of another kind.
std::optional<CommonFaces> common_faces(const Element& element, std::size_t list);

// Returns false if one of the rows has not three corners or refers to more than `vertices`.
template <bool swapped>
bool load_triangles(const char* row, std::size_t row_size, std::size_t count, std::uint32_t vertices,
                    std::array<std::uint32_t, 3>* to) {
  bool are_triangles = true;
  std::uint32_t greatest = 0;
  for (std::size_t i = 0; i < count; ++i, row += row_size) {
    are_triangles &= *row == 3;
    // A negative index becomes a huge one.
    const std::array<std::uint32_t, 3> corners{load<std::uint32_t, swapped>(row + 1),
                                               load<std::uint32_t, swapped>(row + 5),
                                               load<std::uint32_t, swapped>(row + 9)};
    greatest = std::max({greatest, corners[0], corners[1], corners[2]});
    to[i] = corners;
  }
  return are_triangles && greatest < vertices;
}

// Reads triangles as long as whole chunks of rows hold nothing else and refer to vertices that are there.
// Returns their number.
template <class Source>
std::uint64_t read_triangles(Source& source, const CommonFaces& faces, std::uint64_t rows,
                             std::uint32_t vertices, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const std::size_t row_size = faces.triangle_row();
  rows = std::min<std::uint64_t>(rows, source.left() / row_size);
  std::uint64_t done = 0;
  while (done < rows && source.at()[faces.before] == 3) {
    const std::size_t count = std::min<std::uint64_t>(chunk_rows, rows - done), size = triangles.size();
    triangles.resize(size + count);
    if (!load_triangles<Source::swapped>(source.at() + faces.before, row_size, count, vertices,
                                         &triangles[size])) {
      triangles.resize(size);
      break;
    }
    source.skip(count * row_size);
    source.release_read();
    done += count;
  }
  return done;
}

// Reads the rows from `row` to `stop`, of any number of corners.
template <class Source>
void read_common_faces(Source& source, const Element& element, std::size_t list, const CommonFaces& faces,
                       std::uint64_t row, std::uint64_t stop, Body& body) {
  const auto vertices = static_cast<std::uint32_t>(body.mesh.positions.size());
  FaceSink sink(body);
  std::vector<std::uint32_t> corners(255);
  for (; row < stop; ++row) {
    const char* const at = source.at() + faces.before;
    const auto truncated = [&] {
      source.fail(element, fmt::format("the file ends within face {}", row), source.at());
    };
    if (source.left() < faces.before + 1) truncated();
    const std::size_t length = static_cast<unsigned char>(*at);
    const std::size_t size = faces.before + 1 + 4 * length + faces.after;
    if (source.left() < size) truncated();
    std::uint32_t greatest = 0;
    for (std::size_t k = 0; k < length; ++k) {
      corners[k] = load<std::uint32_t, Source::swapped>(at + 1 + 4 * k);
      greatest = std::max(greatest, corners[k]);
    }
    if (length > 0 && greatest >= vertices) {
      const bool is_signed = element.properties[list].type == Type::int32;
      const double index = is_signed ? static_cast<double>(static_cast<std::int32_t>(greatest)) : greatest;
      source.fail(element, out_of_range(index, vertices), at);
    }
    sink.add({corners.data(), length});
    source.skip(size);
  }
  source.release_read();
}

// Reads strips of triangles, each turned the other way round than the one before it; a negative index begins
// the next strip. Triangles with a corner twice only lead from one part of a strip to another.
template <class Source>
void read_strips(Source& source, const Element& element, std::size_t list, Body& body) {
  source.require_room(element);
  const std::size_t vertices = body.mesh.positions.size();
  read_rows(
      source, element, [](std::size_t, double) {},
      [&](std::size_t i, const std::vector<double>& items) {
        if (i != list) return;
        std::array<std::uint32_t, 3> corners{};
        std::size_t length = 0;
        for (const double index : items) {
          if (index < 0) {
            length = 0;
            continue;
          }
          if (!(index < static_cast<double>(vertices)) || index != std::floor(index)) {
            source.fail(element, out_of_range(index, vertices));
          }
          corners = {corners[1], corners[2], static_cast<std::uint32_t>(index)};
          if (++length < 3) continue;
          const auto [a, b, c] = corners;
          if (a == b || b == c || c == a) continue;
          body.mesh.triangles.push_back(length % 2 == 1 ? corners : std::array{b, a, c});
        }
      });
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

// Reserves memory for as many triangles as there could be, each with three indices.
template <class Source>
void reserve_triangles(const Source& source, const Element& element, std::size_t list, Body& body) {
  const std::size_t least =
      Source::binary ? element.row_size() + 3 * size_of(element.properties[list].type) : 8;
  reserve(body.mesh.triangles,
          body.mesh.triangles.size() + std::min<std::uint64_t>(element.count, source.left() / least + 1));
}

// Reads the faces behind the first `row` rows, which have been read.
template <class Source>
void read_faces(Source& source, const Element& element, std::size_t list, std::uint64_t row, Body& body) {
  if constexpr (Source::binary) {
    if (const auto faces = common_faces(element, list)) {
      const auto vertices = static_cast<std::uint32_t>(body.mesh.positions.size());
      while (row < element.count) {
        row += read_triangles(source, *faces, element.count - row, vertices, body.mesh.triangles);
        const std::uint64_t stop = std::min<std::uint64_t>(element.count, row + chunk_rows);
        read_common_faces(source, element, list, *faces, row, stop, body);
        row = stop;
      }
      return;
    }
  }
  read_face_rows(source, element, list, body);
}

}  // namespace vitrail::ply
