// SPDX-License-Identifier: Apache-2.0
#include "bundle/domain_file.h"

#include "bundle/checksum.h"
#include "bundle/domain_layout.h"
#include "bundle/write_file.h"

namespace vitrail {

std::uint64_t layout::checksum_of(DomainHeader header) {
  header.header_checksum = 0;
  return checksum(std::as_bytes(std::span(&header, 1)));
}

DomainView view_of(const DomainContent& content) {
  return {content.nodes,      content.clusters,  content.normals,        content.uvs,
          content.attributes, content.instances, content.instance_nodes, {}};
}

std::uint64_t write_domain_file(const std::filesystem::path& file, const DomainContent& content,
                                std::uint64_t* hash) {
  const std::array<std::span<const std::byte>, layout::section_count> data{
      std::as_bytes(std::span(content.nodes)),          std::as_bytes(std::span(content.clusters)),
      std::as_bytes(std::span(content.normals)),        std::as_bytes(std::span(content.uvs)),
      std::as_bytes(std::span(content.attributes)),     std::as_bytes(std::span(content.pieces)),
      std::as_bytes(std::span(content.piece_vertices)), std::as_bytes(std::span(content.instances)),
      std::as_bytes(std::span(content.instance_nodes))};
  constexpr std::array<std::byte, layout::section_alignment + layout::section_tail> zeros{};

  layout::DomainHeader header;
  std::uint64_t offset = sizeof(header);
  std::array<std::span<const std::byte>, layout::section_count> tails;
  for (std::size_t i = 0; i < layout::section_count; ++i) {
    const std::uint64_t count = data[i].size() / layout::element_size[i];
    const std::uint64_t bytes = layout::padded_bytes(count, layout::element_size[i]);
    tails[i] = std::span(zeros).first(bytes - data[i].size());
    Hasher hasher;
    hasher.add(data[i]);
    hasher.add(tails[i]);
    header.table[i] = {offset, count, hasher.digest(), layout::element_size[i],
                       static_cast<std::uint32_t>(i)};
    offset += bytes;
  }
  header.file_bytes = offset;
  header.header_checksum = layout::checksum_of(header);
  if (hash) *hash = header.header_checksum;

  std::vector<std::span<const std::byte>> parts{std::as_bytes(std::span(&header, 1))};
  for (std::size_t i = 0; i < layout::section_count; ++i) parts.insert(parts.end(), {data[i], tails[i]});
  write_file(file, parts);
  return offset;
}

}  // namespace vitrail
