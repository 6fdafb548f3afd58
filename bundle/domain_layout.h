// SPDX-License-Identifier: Apache-2.0
// A domain file has these bytes: header, section table, sections. See docs/reference/bundle-format.md.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "bundle/domain_file.h"
#include "bundle/features.h"
#include "bundle/piece_code.h"

namespace vitrail::layout {

static_assert(std::endian::native == std::endian::little,
              "domain files are little-endian and mapped as they are");

inline constexpr std::array<char, 8> domain_magic{'V', 'I', 'T', 'R', 'D', 'O', 'M', '\n'};
inline constexpr std::uint32_t domain_version = 5;
inline constexpr std::uint64_t section_alignment = 64;
// It is the least number of zero bytes after each section, since vector loads may read past the end of an
// array.
inline constexpr std::uint64_t section_tail = 16;

enum SectionIndex : std::size_t {
  nodes,
  clusters,
  normals,
  uvs,
  attributes,
  pieces,
  piece_corners,
  cut_vertices,
  instances,
  instance_nodes,
  section_count
};

inline constexpr std::array<std::uint32_t, section_count> element_size{
    sizeof(BvhNode),           sizeof(Cluster),       sizeof(ClusterNormals), sizeof(ClusterUvs),
    sizeof(ClusterAttributes), sizeof(std::uint32_t), sizeof(PieceCorner),    sizeof(Point3d),
    sizeof(InstanceRef),       sizeof(BvhNode)};

inline constexpr std::array<const char*, section_count> section_name{
    "nodes",  "clusters",      "normals",      "uvs",       "attributes",
    "pieces", "piece corners", "cut vertices", "instances", "instance nodes"};

struct Section {
  std::uint64_t offset = 0;    // from the start of the file, a multiple of 64
  std::uint64_t count = 0;     // elements
  std::uint64_t checksum = 0;  // of everything up to the next section, its padding included
  std::uint32_t element_size = 0;
  std::uint32_t kind = 0;  // a SectionIndex; the sections stand in this order
};
static_assert(sizeof(Section) == 32);

// The section table follows the header, with zeros up to a multiple of 64. Sections of kinds beyond those
// above belong to optional features.
struct DomainHeader {
  std::array<char, 8> magic = domain_magic;
  std::uint32_t version = domain_version;
  std::uint32_t sections = section_count;
  std::uint64_t file_bytes = 0;
  std::uint64_t header_checksum = 0;  // of this header, with this field 0, and the table with its zeros
  Features features;
  std::array<std::uint64_t, 3> reserved{};
};
static_assert(sizeof(DomainHeader) == section_alignment);

inline constexpr std::uint32_t most_sections = 256;

// Returns the size of the header with its table.
constexpr std::uint64_t header_bytes(std::uint64_t sections) {
  return (sizeof(DomainHeader) + sections * sizeof(Section) + section_alignment - 1) / section_alignment *
         section_alignment;
}

// Returns the bytes that a section takes in the file, padding included.
constexpr std::uint64_t padded_bytes(std::uint64_t count, std::uint64_t element) {
  const std::uint64_t bytes = count * element;
  return count == 0 ? 0
                    : (bytes + section_tail + section_alignment - 1) / section_alignment * section_alignment;
}

std::uint64_t checksum_of(DomainHeader header, std::span<const std::byte> table);

// Returns the features of a file with these sections.
Features features_of(std::span<const Section> sections);

}  // namespace vitrail::layout
