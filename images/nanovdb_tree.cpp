// SPDX-License-Identifier: Apache-2.0
#include "images/nanovdb_tree.h"

#include <algorithm>
#include <set>

namespace vitrail::nanovdb_file {

namespace {

// Layouts, by the library's own records; nothing of it looks at the bytes.
using Leaf = nanovdb::NanoLeaf<float>::DataType;
using Lower = nanovdb::NanoLower<float>::DataType;
using Upper = nanovdb::NanoUpper<float>::DataType;
using Root = nanovdb::NanoRoot<float>::DataType;

// Voxels along an edge: of a leaf, of the nodes above.
constexpr std::int64_t leaf_edge = 8, lower_edge = 16 * leaf_edge, upper_edge = 32 * lower_edge;

using Place = std::array<std::int64_t, 3>;

// The bytes of a grid as they lie in memory.
class Records {
 public:
  Records(std::span<const char> bytes, const File& file) : bytes_(bytes), file_(file) {}

  const char* from(std::uint64_t offset, std::uint64_t size) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset) fail("a node lies outside of its grid");
    return bytes_.data() + offset;
  }
  template <class T>
  T at(std::uint64_t offset) const {
    T value;
    std::memcpy(&value, from(offset, sizeof(T)), sizeof(T));
    return value;
  }
  [[noreturn]] void fail(const char* message) const { file_.fail(message); }

 private:
  std::span<const char> bytes_;
  const File& file_;
};

class DenseReader {
 public:
  DenseReader(const Records& grid, const VoxelBox& box)
      : grid_(grid), box_(box), values_(box.extent(0) * box.extent(1) * box.extent(2)) {}

  std::vector<float> read() {
    const auto tree = grid_.at<nanovdb::TreeData<>>(sizeof(nanovdb::GridData));
    const std::uint64_t root = sizeof(nanovdb::GridData) + tree.mNodeOffset[3];
    std::fill(values_.begin(), values_.end(), grid_.at<float>(root + offsetof(Root, mBackground)));
    const auto tiles = grid_.at<std::uint32_t>(root + offsetof(Root, mTableSize));
    for (std::uint64_t i = 0; i < tiles; ++i) read_tile(root, root + sizeof(Root) + i * sizeof(Root::Tile));
    return std::move(values_);
  }

 private:
  void read_tile(std::uint64_t root, std::uint64_t tile) {
    const auto key = grid_.at<Root::KeyT>(tile + offsetof(Root::Tile, key));
    const nanovdb::Coord origin = Root::KeyToCoord(key);
    const Place at{origin[0], origin[1], origin[2]};
    if (!meets(at, upper_edge)) return;
    if (!seen_.insert(at).second) grid_.fail("two tiles of a root at one place");
    const auto child = grid_.at<std::int64_t>(tile + offsetof(Root::Tile, child));
    if (child == 0) return fill(at, upper_edge, grid_.at<float>(tile + offsetof(Root::Tile, value)));
    read_inner<Upper, 32>(at_offset(root, child), at, lower_edge);
  }

  // Negative sums become places that no file has.
  static std::uint64_t at_offset(std::uint64_t from, std::int64_t by) {
    return from + static_cast<std::uint64_t>(by);
  }

  // A node of edge³ children, each of `child_edge` voxels: nodes, or tiles of one value.
  template <class Node, std::int64_t edge>
  void read_inner(std::uint64_t node, const Place& origin, std::int64_t child_edge) {
    const char* const children = grid_.from(node + offsetof(Node, mChildMask), edge * edge * edge / 8);
    for (std::int64_t x = 0; x < edge; ++x)
      for (std::int64_t y = 0; y < edge; ++y)
        for (std::int64_t z = 0; z < edge; ++z) {
          const Place at{origin[0] + x * child_edge, origin[1] + y * child_edge, origin[2] + z * child_edge};
          if (!meets(at, child_edge)) continue;
          const auto n = static_cast<std::uint64_t>((x * edge + y) * edge + z);
          const std::uint64_t entry = node + offsetof(Node, mTable) + n * sizeof(std::int64_t);
          if ((children[n / 8] >> (n % 8) & 1) == 0)
            fill(at, child_edge, grid_.at<float>(entry));
          else
            read_child(at_offset(node, grid_.at<std::int64_t>(entry)), at, child_edge);
        }
  }

  void read_child(std::uint64_t node, const Place& at, std::int64_t edge) {
    if (edge == lower_edge) return read_inner<Lower, 16>(node, at, leaf_edge);
    const char* const values = grid_.from(node + offsetof(Leaf, mValues), sizeof(Leaf::mValues));
    for_each(at, edge, [&](const Place& voxel, float& value) {
      const auto n = ((voxel[0] - at[0]) * edge + voxel[1] - at[1]) * edge + voxel[2] - at[2];
      std::memcpy(&value, values + n * static_cast<std::int64_t>(sizeof value), sizeof value);
    });
  }

  bool meets(const Place& at, std::int64_t edge) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (at[k] > box_.last[k] || at[k] + edge <= box_.first[k]) return false;
    return true;
  }

  void fill(const Place& at, std::int64_t edge, float with) {
    for_each(at, edge, [&](const Place&, float& value) { value = with; });
  }

  // The voxels of the cube that are in the box.
  template <class F>
  void for_each(const Place& at, std::int64_t edge, F&& use) {
    Place first, end;
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = std::max(at[k], box_.first[k]);
      end[k] = std::min(at[k] + edge, box_.last[k] + 1);
    }
    const auto nx = static_cast<std::int64_t>(box_.extent(0)), ny = static_cast<std::int64_t>(box_.extent(1));
    for (std::int64_t z = first[2]; z < end[2]; ++z)
      for (std::int64_t y = first[1]; y < end[1]; ++y)
        for (std::int64_t x = first[0]; x < end[0]; ++x) {
          const std::int64_t row = (z - box_.first[2]) * ny + y - box_.first[1];
          use({x, y, z}, values_[static_cast<std::size_t>(row * nx + x - box_.first[0])]);
        }
  }

  const Records& grid_;
  const VoxelBox& box_;
  std::vector<float> values_;
  std::set<Place> seen_;
};

}  // namespace

std::vector<float> dense_values(std::span<const char> grid, const VoxelBox& box, const File& file) {
  const Records records(grid, file);
  return DenseReader(records, box).read();
}

}  // namespace vitrail::nanovdb_file
