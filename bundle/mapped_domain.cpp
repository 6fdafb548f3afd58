// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "bundle/checksum.h"
#include "bundle/domain_file.h"
#include "bundle/domain_layout.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& what) {
  throw Error("domain file is damaged: " + what + "; partition the scene again", {file.string()});
}

std::span<const std::byte> map(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    throw MachineError(fmt::format("cannot open {}: {}", file.string(), std::strerror(errno)));
  struct stat status {};
  void* data = MAP_FAILED;
  if (::fstat(descriptor, &status) == 0 && status.st_size > 0)
    data = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int reason = errno;
  ::close(descriptor);
  if (status.st_size == 0) reject(file, "it is empty");
  if (data == MAP_FAILED)
    throw MachineError(fmt::format("cannot map {}: {}", file.string(), std::strerror(reason)));
  return {static_cast<const std::byte*>(data), static_cast<std::size_t>(status.st_size)};
}

const layout::DomainHeader& header_of(const std::byte* data) {
  return *reinterpret_cast<const layout::DomainHeader*>(data);
}

template <class T>
std::span<const T> elements(const std::byte* data, layout::SectionIndex index) {
  const layout::Section& s = header_of(data).table[index];
  return {reinterpret_cast<const T*>(data + s.offset), s.count};
}

// The header is whole and its sections follow each other from its end to the end of the file.
void check_header(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const layout::DomainHeader& header = header_of(bytes.data());
  if (bytes.size() < 16 || header.magic != layout::domain_magic)
    throw Error("not a domain file", {file.string()});
  if (header.version != layout::domain_version)
    throw Error(fmt::format("domain file of version {}; this program reads version {}", header.version,
                            layout::domain_version),
                {file.string()});
  if (bytes.size() < sizeof(header)) reject(file, "its header is cut short");
  if (header.header_checksum != layout::checksum_of(header))
    reject(file, "the checksum of its header is wrong");
  if (header.file_bytes != bytes.size())
    reject(file, fmt::format("it has {} bytes and should have {}", bytes.size(), header.file_bytes));
  std::uint64_t expected = sizeof(header);
  for (std::size_t i = 0; i < layout::section_count; ++i) {
    const layout::Section& s = header.table[i];
    if (s.kind != i || s.element_size != layout::element_size[i] || s.offset != expected ||
        s.count > bytes.size() / s.element_size)
      reject(file, fmt::format("section {} has a wrong size or place", i));
    expected += layout::padded_bytes(s.count, s.element_size);
  }
  if (header.sections != layout::section_count || expected != bytes.size())
    reject(file, "its sections do not fill it");
}

void check_section(const std::filesystem::path& file, const std::byte* data, layout::SectionIndex index) {
  const layout::Section& s = header_of(data).table[index];
  if (checksum({data + s.offset, layout::padded_bytes(s.count, s.element_size)}) != s.checksum)
    reject(file, fmt::format("the checksum of section {} is wrong", static_cast<int>(index)));
}

// Marks what has been referred to; false where it already was.
class OnceEach {
 public:
  explicit OnceEach(std::size_t size) : seen_(size, false) {}
  bool mark(std::size_t i) {
    if (seen_[i]) return false;
    seen_[i] = true;
    ++count_;
    return true;
  }
  bool all() const { return count_ == seen_.size(); }

 private:
  std::vector<bool> seen_;
  std::size_t count_ = 0;
};

// Children come after their parent and every node and leaf (cluster or instance) hangs in exactly one place,
// so a traversal ends and its stack is bounded by the depth.
void check_tree(const std::filesystem::path& file, std::span<const BvhNode> tree, std::size_t leaf_count,
                const char* leaf) {
  OnceEach nodes(tree.size()), leaves(leaf_count);
  std::vector<std::uint8_t> depth(tree.size(), 1);
  if (!tree.empty()) nodes.mark(0);
  for (std::size_t i = 0; i < tree.size(); ++i)
    for (const std::uint32_t child : tree[i].child) {
      if (child == BvhNode::empty) continue;
      const std::size_t index = child & ~BvhNode::cluster_bit;
      if (child & BvhNode::cluster_bit) {
        if (index >= leaf_count || !leaves.mark(index))
          reject(file, fmt::format("node {} refers to {} {}", i, leaf, index));
      } else {
        if (index <= i || index >= tree.size() || !nodes.mark(index))
          reject(file, fmt::format("node {} refers to node {}", i, index));
        depth[index] = static_cast<std::uint8_t>(depth[i] + 1);
        if (depth[index] > max_bvh_depth) reject(file, "its tree is too deep");
      }
    }
  if (!nodes.all() || !leaves.all()) reject(file, fmt::format("its tree does not reach every {}", leaf));
}

void check_instances(const std::filesystem::path& file, std::span<const InstanceRef> instances) {
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const InstanceRef& ref = instances[i];
    bool finite = true;
    for (const auto& row : ref.to_parent.m)
      for (const double x : row) finite = finite && std::isfinite(x);
    for (int axis = 0; axis < 3; ++axis)
      finite = finite && std::isfinite(ref.lower[axis]) && std::isfinite(ref.upper[axis]) &&
               ref.lower[axis] <= ref.upper[axis];
    if (!finite) reject(file, fmt::format("instance {} stands nowhere", i));
  }
}

}  // namespace

MappedDomain::MappedDomain(const std::filesystem::path& file) : file_(file) {
  const std::span<const std::byte> bytes = map(file);
  data_ = bytes.data();
  bytes_ = bytes.size();
  try {
    check_header(file, bytes);
    for (const auto section : {layout::nodes, layout::clusters, layout::normals, layout::uvs,
                               layout::attributes, layout::instances, layout::instance_nodes})
      check_section(file, data_, section);
    view_ = {elements<BvhNode>(data_, layout::nodes),
             elements<Cluster>(data_, layout::clusters),
             elements<ClusterNormals>(data_, layout::normals),
             elements<ClusterUvs>(data_, layout::uvs),
             elements<ClusterAttributes>(data_, layout::attributes),
             elements<InstanceRef>(data_, layout::instances),
             elements<BvhNode>(data_, layout::instance_nodes),
             {}};
    if (!view_.normals.empty() && view_.normals.size() != view_.clusters.size())
      reject(file, "it does not have one group of normals a cluster");
    if (!view_.uvs.empty() && view_.uvs.size() != view_.clusters.size())
      reject(file, "it does not have one group of (u,v) a cluster");
    check_tree(file, view_.nodes, view_.clusters.size(), "cluster");
    check_tree(file, view_.instance_nodes, view_.instances.size(), "instance");
    check_instances(file, view_.instances);
  } catch (...) {
    ::munmap(const_cast<std::byte*>(data_), bytes_);
    throw;
  }
}

MappedDomain::~MappedDomain() { ::munmap(const_cast<std::byte*>(data_), bytes_); }

std::uint64_t MappedDomain::hash() const { return header_of(data_).header_checksum; }

std::span<const Piece> MappedDomain::pieces() const {
  check_section(file_, data_, layout::pieces);
  const auto pieces = elements<Piece>(data_, layout::pieces);
  const std::uint64_t vertices = header_of(data_).table[layout::piece_vertices].count;
  for (const Piece& p : pieces)
    if (p.vertex_count < 3 || p.first_vertex > vertices || p.vertex_count > vertices - p.first_vertex)
      reject(file_, fmt::format("a piece of triangle {} refers to vertices that are not there", p.triangle));
  return pieces;
}

std::span<const Point3d> MappedDomain::piece_vertices() const {
  check_section(file_, data_, layout::piece_vertices);
  return elements<Point3d>(data_, layout::piece_vertices);
}

}  // namespace vitrail
