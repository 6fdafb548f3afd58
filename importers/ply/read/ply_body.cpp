// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply_body.h"

#include <tbb/parallel_invoke.h>

#include "importers/ply/read/ply_faces.h"

namespace vitrail::ply {

std::optional<CommonFaces> common_faces(const Element& element, std::size_t list) {
  const Property& corners = element.properties[list];
  const auto lists =
      std::ranges::count_if(element.properties, [](const Property& p) { return p.count_type.has_value(); });
  const bool words = corners.type == Type::int32 || corners.type == Type::uint32;
  if (lists != 1 || !words || size_of(*corners.count_type) != 1) return {};
  CommonFaces faces;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (i != list) (i < list ? faces.before : faces.after) += size_of(element.properties[i].type);
  }
  return faces;
}

namespace {

// Reads the elements in their order, but faces and strips never before the vertices.
template <class Source>
class BodyReader {
 public:
  BodyReader(const Source& source, const Header& header, const BodyPlan& plan, std::optional<PbrtQuads> quads)
      : source_(source), header_(header), plan_(plan) {
    body_.quads = quads;
  }

  Body read() {
    std::size_t last = plan_.vertex_element;
    for (const auto& faces : {plan_.faces, plan_.strips}) {
      if (faces) last = std::max(last, faces->element);
    }
    std::optional<Source> early_faces, early_strips;
    for (std::size_t i = 0; i <= last; ++i) {
      const bool early = i < plan_.vertex_element;
      if (i == plan_.vertex_element) {
        read_vertices();
      } else if (is(plan_.faces, i)) {
        if (early) early_faces = source_;
        early ? skip_element(source_, header_.elements[i]) : read_faces(source_);
      } else if (is(plan_.strips, i)) {
        if (early) early_strips = source_;
        early ? skip_element(source_, header_.elements[i]) : read_strips(source_);
      } else {
        skip_element(source_, header_.elements[i]);
      }
    }
    if (early_faces) read_faces(*early_faces);
    if (early_strips) read_strips(*early_strips);
    return std::move(body_);
  }

 private:
  static bool is(const std::optional<BodyPlan::Faces>& faces, std::size_t element) {
    return faces && faces->element == element;
  }

  void read_vertices() {
    const Element& vertex = header_.elements[plan_.vertex_element];
    prepare_vertices(source_, vertex, plan_.vertex, body_.mesh);
    if (!read_with_triangles(vertex)) read_vertices(vertex);
  }

  void read_vertices(const Element& vertex) {
    body_.lost_numbers = ply::read_vertices(source_, vertex, plan_.vertex, body_.mesh);
  }

  // Vertices on one thread and the triangles behind them on another. False where the file is too small for
  // that or is of another kind. What is wrong with the faces is left to be found in its turn.
  bool read_with_triangles(const Element& vertex) {
    if constexpr (Source::binary) {
      constexpr std::size_t least_bytes = 1u << 20;
      if (source_.left() < least_bytes || vertex.has_list() || !is(plan_.faces, plan_.vertex_element + 1))
        return false;
      const Element& face = header_.elements[plan_.faces->element];
      const auto faces = common_faces(face, plan_.faces->corner_list);
      if (!faces) return false;
      Source triangles = source_;
      triangles.skip(vertex.count * vertex.row_size());
      if (!triangles.has_room(face)) return false;
      reserve_triangles(triangles, face, plan_.faces->corner_list, body_);
      tbb::parallel_invoke([&] { read_vertices(vertex); },
                           [&] {
                             faces_read_ = read_triangles(triangles, *faces, face.count,
                                                          static_cast<std::uint32_t>(vertex.count),
                                                          body_.mesh.triangles);
                           });
      source_ = triangles;
      return true;
    }
    return false;
  }

  void read_faces(Source& source) {
    const Element& element = header_.elements[plan_.faces->element];
    if (faces_read_ == 0) {
      source.require_room(element);
      reserve_triangles(source, element, plan_.faces->corner_list, body_);
    }
    ply::read_faces(source, element, plan_.faces->corner_list, faces_read_, body_);
  }

  void read_strips(Source& source) {
    ply::read_strips(source, header_.elements[plan_.strips->element], plan_.strips->corner_list, body_);
  }

  Source source_;
  const Header& header_;
  const BodyPlan& plan_;
  Body body_;
  std::uint64_t faces_read_ = 0;
};

template <class Source>
Body read(const InputBytes& bytes, const TextCursor& cursor, const Header& header, const BodyPlan& plan,
          std::optional<PbrtQuads> quads) {
  return BodyReader<Source>(Source(bytes, cursor), header, plan, quads).read();
}

}  // namespace

Body read_body(const InputBytes& bytes, const TextCursor& cursor, const Header& header, const BodyPlan& plan,
               std::optional<PbrtQuads> quads) {
  switch (header.format) {
    case Format::ascii:
      return read<AsciiSource>(bytes, cursor, header, plan, quads);
    case Format::binary_big_endian:
      return read<BinarySource<true>>(bytes, cursor, header, plan, quads);
    default:
      return read<BinarySource<false>>(bytes, cursor, header, plan, quads);
  }
}

}  // namespace vitrail::ply
