// SPDX-License-Identifier: Apache-2.0
#include "bundle/domain_file.h"

#include <algorithm>

#include "bundle/checksum.h"
#include "bundle/domain_layout.h"
#include "bundle/piece_code.h"
#include "bundle/write_file.h"

namespace vitrail {

std::uint64_t layout::checksum_of(DomainHeader header, std::span<const std::byte> table) {
  header.header_checksum = 0;
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&header, 1)));
  hasher.add(table);
  return hasher.digest();
}

Features layout::features_of(std::span<const Section> sections) {
  constexpr std::array required{
      std::pair{normals, required_feature::normals}, std::pair{uvs, required_feature::uvs},
      std::pair{attributes, required_feature::attributes}, std::pair{instances, required_feature::instances}};
  Features f;
  for (const auto& [section, bit] : required)
    if (sections[section].count > 0) f.required |= bit;
  if (sections[pieces].count > 0) f.optional |= optional_feature::pieces;
  return f;
}

DomainView view_of(const DomainContent& content) {
  DomainView view{content.nodes,      content.clusters,  content.normals,        content.uvs,
                  content.attributes, content.instances, content.instance_nodes, {}};
  view.reach = reach_of(view);
  return view;
}

std::array<Point3d, 3> triangle_in(const Cluster& c, std::size_t lane) {
  std::array<Point3d, 3> v;
  for (std::size_t k = 0; k < 3; ++k)
    v[k] = {double{c.vertex[k][0][lane]}, double{c.vertex[k][1][lane]}, double{c.vertex[k][2][lane]}};
  return v;
}

std::uint64_t triangles_in(std::span<const Cluster> clusters) {
  std::uint64_t filled = 0;
  for (const Cluster& c : clusters)
    for (const std::uint32_t id : c.id) filled += id != no_triangle;
  return filled;
}

Bounds3f content_bounds(const DomainView& view) {
  Bounds3f box;
  for (const std::span<const BvhNode> tree : {view.nodes, view.instance_nodes})
    for (std::size_t i = 0; i < 8 && !tree.empty(); ++i) {
      const BvhNode& root = tree[0];
      if (root.child[i] == BvhNode::empty) continue;
      extend(box, Bounds3f{{root.lower[0][i], root.lower[1][i], root.lower[2][i]},
                           {root.upper[0][i], root.upper[1][i], root.upper[2][i]}});
    }
  return box;
}

float reach_of(const DomainView& view) {
  const Bounds3f box = content_bounds(view);
  float reach = 0;
  for (int axis = 0; axis < 3 && !box.empty(); ++axis)
    reach = std::max({reach, -box.lower[axis], box.upper[axis]});
  return reach;
}

std::uint64_t write_domain_file(const std::filesystem::path& file, const DomainContent& content,
                                std::uint64_t* hash) {
  const PieceCode pieces = encode_pieces(content.clusters, content.pieces, content.piece_vertices);
  const std::array<std::span<const std::byte>, layout::section_count> data{
      std::as_bytes(std::span(content.nodes)),      std::as_bytes(std::span(content.clusters)),
      std::as_bytes(std::span(content.normals)),    std::as_bytes(std::span(content.uvs)),
      std::as_bytes(std::span(content.attributes)), std::as_bytes(std::span(pieces.triangles)),
      std::as_bytes(std::span(pieces.corners)),     std::as_bytes(std::span(pieces.cut_vertices)),
      std::as_bytes(std::span(content.instances)),  std::as_bytes(std::span(content.instance_nodes))};
  constexpr std::array<std::byte, layout::section_alignment + layout::section_tail> zeros{};

  // With zeros up to a multiple of 64.
  constexpr std::uint64_t table_bytes =
      layout::header_bytes(layout::section_count) - sizeof(layout::DomainHeader);
  std::array<layout::Section, table_bytes / sizeof(layout::Section)> sections{};
  std::uint64_t offset = layout::header_bytes(layout::section_count);
  std::array<std::span<const std::byte>, layout::section_count> tails;
  for (std::size_t i = 0; i < layout::section_count; ++i) {
    const std::uint64_t count = data[i].size() / layout::element_size[i];
    const std::uint64_t bytes = layout::padded_bytes(count, layout::element_size[i]);
    tails[i] = std::span(zeros).first(bytes - data[i].size());
    Hasher hasher;
    hasher.add(data[i]);
    hasher.add(tails[i]);
    sections[i] = {offset, count, hasher.digest(), layout::element_size[i], static_cast<std::uint32_t>(i)};
    offset += bytes;
  }
  layout::DomainHeader header;
  header.file_bytes = offset;
  header.features = layout::features_of(sections);
  header.header_checksum = layout::checksum_of(header, std::as_bytes(std::span(sections)));
  if (hash) *hash = header.header_checksum;

  std::vector<std::span<const std::byte>> parts{std::as_bytes(std::span(&header, 1)),
                                                std::as_bytes(std::span(sections))};
  for (std::size_t i = 0; i < layout::section_count; ++i) parts.insert(parts.end(), {data[i], tails[i]});
  write_file(file, parts);
  return offset;
}

}  // namespace vitrail
