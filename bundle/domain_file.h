// SPDX-License-Identifier: Apache-2.0
// A domain file holds one sub-domain: an 8-wide BVH over clusters of at most 8 triangles, ready to be mapped
// and traced. An object has a file of the same form. docs/reference/bundle-format.md describes the byte
// layout.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bundle/instance.h"
#include "bundle/oriented_quadric.h"
#include "scene/geometry/bounds.h"
#include "scene/geometry/vec.h"

namespace vitrail {

class Motion;
class RegularFile;

namespace layout {  // domain_layout.h
struct DomainHeader;
struct Section;
}  // namespace layout

inline constexpr int cluster_width = 8;
// This id marks an empty lane of a cluster, and means "no triangle" wherever a triangle id is expected.
inline constexpr std::uint32_t no_triangle = 0xffffffffu;
// It is the most levels that a tree of nodes may have. A depth-first traversal needs at most 7·96 + 8 stack
// entries.
inline constexpr int max_bvh_depth = 96;

// A cluster holds up to 8 triangles as a structure of arrays. The vertices are the uncut triangle's, whatever
// part of it lies in this domain. Empty lanes hold NaN vertices (every ordered comparison rejects them) and
// the id `no_triangle`.
struct alignas(64) Cluster {
  float vertex[3][3][cluster_width];  // [vertex][axis][lane]
  std::uint32_t id[cluster_width];    // global triangle id
};
static_assert(sizeof(Cluster) == 320);

// The box of a triangle, or of its piece, is inflated by padding(greatest): `greatest` is the greatest
// |coordinate| of the uncut triangle. The float error of a vertex is 6e-8 of it, and the padding exceeds the
// error of a hit. The term 1e-37 keeps it a normal float for the smallest triangles.
inline constexpr double relative_padding = 2e-6;
inline double padding(double greatest) { return relative_padding * greatest + 1e-37; }

// A node holds 8 child boxes, already inflated, and what is in them. Empty children have an inverted box (+∞
// … −∞).
struct alignas(64) BvhNode {
  static constexpr std::uint32_t cluster_bit = 0x80000000u;
  static constexpr std::uint32_t empty = 0xffffffffu;
  float lower[3][8];       // [axis][child]
  float upper[3][8];       // [axis][child]
  std::uint32_t child[8];  // index of a node, or cluster_bit | index of a cluster, or `empty`
  std::uint32_t padding[8];
};
static_assert(sizeof(BvhNode) == 256);

// It holds the shading normals of a cluster's triangles, octahedrally encoded (encode_normal),
// [lane][vertex]. A triangle without its own has the three normals equal to no_normal.
struct ClusterNormals {
  std::uint32_t normal[cluster_width][3];
};
static_assert(sizeof(ClusterNormals) == 96);

// It holds the (u,v) of a cluster's triangles, [lane][vertex][u, v]; 0 where a triangle has none.
struct ClusterUvs {
  float uv[cluster_width][3][2];
};
static_assert(sizeof(ClusterUvs) == 192);

// It holds one mesh attribute of a cluster's triangles, [lane][vertex][channel]; 0 where a triangle has none.
struct ClusterAttributes {
  float value[cluster_width][3][3];
};
static_assert(sizeof(ClusterAttributes) == 288);

// Unit normals are stored as two 16-bit signed octahedral coordinates (Meyer et al. 2010). The code uses + −
// × ÷ √ only.
inline constexpr std::uint32_t no_normal = 0x80008000u;
std::uint32_t encode_normal(Normal3d n);
Normal3f decode_normal(std::uint32_t code);

// A Piece is the part of a cut triangle that lies in this domain: a convex polygon in the plane of the
// triangle. It has vertices [first_vertex, first_vertex + vertex_count) of the piece vertices, in the
// triangle's own winding.
struct Piece {
  std::uint32_t triangle = no_triangle;
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
};

// Pieces stand in the order of the clusters and of their lanes. A triangle has one at most.
struct PieceList {
  std::vector<Piece> pieces;
  std::vector<Point3d> vertices;
};

// It holds the content of a domain file in memory. Node 0 is the root; an empty domain has no nodes.
struct DomainContent {
  std::vector<BvhNode> nodes;
  std::vector<Cluster> clusters;
  std::vector<ClusterNormals> normals;        // empty, or one a cluster
  std::vector<ClusterUvs> uvs;                // empty, or one a cluster
  std::vector<ClusterAttributes> attributes;  // as many a cluster as the manifest has slots
  std::vector<Piece> pieces;                  // as in a PieceList
  std::vector<Point3d> piece_vertices;
  std::vector<InstanceRef> instances;
  std::vector<BvhNode> instance_nodes;  // a tree over the instances, whose indices take the clusters' place
};

// A DomainView has views into a mapped file (or into a DomainContent): all that tracing touches.
struct DomainView {
  std::span<const BvhNode> nodes;
  std::span<const Cluster> clusters;
  std::span<const ClusterNormals> normals;
  std::span<const ClusterUvs> uvs;
  std::span<const ClusterAttributes> attributes;
  std::span<const InstanceRef> instances;
  std::span<const BvhNode> instance_nodes;
  // These are the objects that a domain's instances and theirs need, by number. Whoever loads the domain sets
  // them, and `quadric` and `motion` of each.
  std::span<const DomainView* const> objects;
  const OrientedQuadric* quadric = nullptr;  // if it is one: all the rest is empty
  const Motion* motion = nullptr;            // if it moves: of all that is in it
  float reach = 0;                           // no |coordinate| in the trees is greater
};

DomainView view_of(const DomainContent& content);

// Returns the vertices of the triangle that a lane holds.
std::array<Point3d, 3> triangle_in(const Cluster& cluster, std::size_t lane);
// Returns how many lanes are not empty.
std::uint64_t triangles_in(std::span<const Cluster> clusters);
// Returns the bounds of all that is in the trees, padded as their boxes are.
Bounds3f content_bounds(const DomainView& view);
float reach_of(const DomainView& view);

// Writes the file, without syncing, and returns its size in bytes. `hash`, if given, gets what
// MappedDomain::hash will be. Throws MachineError, and then leaves no file.
std::uint64_t write_domain_file(const std::filesystem::path& file, const DomainContent& content,
                                std::uint64_t* hash = nullptr);

// A Stored says where a domain or an object is: a file, or a part of a pack (packs.h).
struct Stored {
  std::filesystem::path file;
  std::uint64_t offset = 0;                           // a multiple of pack_page
  std::optional<std::uint64_t> bytes = std::nullopt;  // none: all of the file
  // Returns a name for messages: "domains/pack-0000 at byte 4096", or the file's own where it is a whole
  // file.
  std::filesystem::path name() const;
};

// A MappedDomain is a domain file mapped read-only. The destructor unmaps it.
class MappedDomain {
 public:
  // Maps the file and verifies header, sizes, checksums of the traced sections and every reference in them.
  // The references of a file with the hash `checked` are known to be good and are not looked at again.
  // Anything wrong throws Error with the file's name; a file that cannot be opened throws MachineError.
  explicit MappedDomain(const std::filesystem::path& file) : MappedDomain(Stored{file}) {}
  explicit MappedDomain(const Stored& stored, std::optional<std::uint64_t> checked = std::nullopt);
  // Maps a file that is open already.
  MappedDomain(const RegularFile& open, const Stored& stored,
               std::optional<std::uint64_t> checked = std::nullopt);
  ~MappedDomain();
  MappedDomain(const MappedDomain&) = delete;
  MappedDomain& operator=(const MappedDomain&) = delete;

  const DomainView& view() const { return view_; }
  std::uint64_t bytes() const { return bytes_; }
  // Returns the hash of the header. The header holds the checksums of all sections, so its hash stands for
  // the whole content.
  std::uint64_t hash() const;

  const layout::DomainHeader& header() const;
  std::span<const layout::Section> sections() const;

  // Decodes the pieces from the cold sections, which it verifies at each call.
  PieceList pieces() const;
  // Verifies the checksums of all that the constructor leaves out.
  void check_cold() const;

 private:
  const std::byte* data_ = nullptr;
  std::uint64_t bytes_ = 0;
  std::filesystem::path file_;
  DomainView view_;
};

// Reads the instances of a domain file, without the rest of it.
std::vector<InstanceRef> read_instances(const Stored& stored);

}  // namespace vitrail
