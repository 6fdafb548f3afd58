// SPDX-License-Identifier: Apache-2.0
#include "partitioner/hierarchy/binary_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "scene/shapes/deferred_mesh.h"
#include "scene/system/huge_pages.h"

namespace vitrail {

namespace {

constexpr std::size_t bucket_size = 1024, sampling = 8, least_samples = 64;
constexpr int most_bucket_levels = 24;
constexpr unsigned wide = 8;             // children of a node of the tree that it becomes
constexpr int most_levels_by_area = 60;  // below, each level halves what is left: at most 32 more

// To the end, even where an error elsewhere cancels the work that this is a part of: what comes next reads
// all that is written here.
template <class Visit>
void for_all(std::size_t count, const Visit& visit) {
  tbb::task_group_context alone(tbb::task_group_context::isolated);
  tbb::parallel_for(std::size_t{0}, count, visit, alone);
}

// [i]: least sum of the areas of the wide nodes below when the subtree hangs in its parent as at most
// i = 1 … 8 children.
using Costs = std::array<float, 9>;

// The wide tree of least SAH cost, by dynamic programming from the leaves (Ylitie, Karras & Laine 2017). The
// clusters are given, so that only the areas of the nodes count.
Costs plan_wide_node(BinaryNode& node, const Costs& first, const Costs& second) {
  Costs cost;
  cost[2] = first[1] + second[1];
  node.share[0] = 1;
  for (std::size_t i = 3; i <= 8; ++i) {
    cost[i] = cost[i - 1];
    std::size_t best = 0;
    for (std::size_t share = 1; share < i; ++share) {
      const float c = first[share] + second[i - share];
      best = c < cost[i] ? share : best;
      cost[i] = c < cost[i] ? c : cost[i];
    }
    node.share[i - 2] = static_cast<std::uint8_t>(best);
  }
  cost[1] = half_area(node.upper - node.lower) + cost[8];
  return cost;
}

BoxRecord record_of(const Bounds3f& b, std::size_t i) {
  return {{b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z, 0},
          static_cast<std::uint32_t>(i)};
}

// Those below in front, in their order; the others behind, in reverse. Returns the number of those below.
std::size_t partition(std::span<const BoxRecord> from, BoxRecord* to, const SahSplit& split) {
  BoxRecord *front = to, *back = to + from.size() - 1;
  for (const BoxRecord& r : from) {
    const bool below = split.below(r);
    *front = r;
    *back = r;
    front += below;
    back -= !below;
  }
  return static_cast<std::size_t>(front - to);
}

// The subtree of one bucket.
class BucketBuilder {
 public:
  BucketBuilder(unsigned leaf_size, BinaryNode* nodes, std::uint32_t first_node, std::uint32_t* order)
      : leaf_size_(leaf_size),
        block_(leaf_size == 1 ? wide : leaf_size),
        nodes_(nodes),
        next_node_(first_node),
        order_(order) {}

  // Of `boxes`, whose leaves begin at `first` of the order; `spare` has room for as many.
  Costs build(std::span<BoxRecord> boxes, BoxRecord* spare, std::uint32_t first, int level) {
    BinaryNode& node = nodes_[next_node_++];
    WideBounds bounds, centres;
    for (const BoxRecord& r : boxes) {
      const Float4 centre = r.centre();
      bounds.extend(r.lower(), r.upper());
      centres.extend(centre, centre);
    }
    node.lower = bounds.lower, node.upper = bounds.upper;
    if (boxes.size() <= leaf_size_) return make_leaf(node, boxes, first);
    std::size_t below = 0;
    if (level < most_levels_by_area)
      if (const auto split = choose_split(boxes, centres, block_)) below = partition(boxes, spare, *split);
    if (below == 0 || below == boxes.size()) {
      below = boxes.size() / 2;
      std::ranges::copy(boxes, spare);
    }
    const auto child = [&](int i, std::size_t begin, std::size_t size) {
      node.child[i] = next_node_;
      return build({spare + begin, size}, boxes.data() + begin, first + static_cast<std::uint32_t>(begin),
                   level + 1);
    };
    const Costs low = child(0, 0, below), high = child(1, below, boxes.size() - below);
    return plan_wide_node(node, low, high);
  }

 private:
  Costs make_leaf(BinaryNode& node, std::span<const BoxRecord> boxes, std::uint32_t first) {
    node.child[0] = node.child[1] = 0;
    node.first = first;
    node.count = static_cast<std::uint32_t>(boxes.size());
    std::uint32_t* out = order_ + first;
    for (const BoxRecord& r : boxes) *out++ = r.reference;
    std::sort(order_ + first, out);
    return {};
  }

  unsigned leaf_size_;
  unsigned block_;  // that a split is to fill: of a leaf, or of a wide node whose children are leaves of one
  BinaryNode* nodes_;
  std::uint32_t next_node_;
  std::uint32_t* order_;
};

// The top of the tree, from a sample. A bucket is a node without a split, whose children are itself.
struct Top {
  struct Node {
    SahSplit split;
    std::uint32_t child[2];
    std::uint32_t bucket;
  };
  std::vector<Node> nodes;
  std::uint32_t buckets = 0;
  int levels = 0;

  bool is_bucket(std::uint32_t node) const { return nodes[node].child[0] == node; }

  // Sixteen at a time: each takes its way down one load after the other, but not after the others' loads.
  static constexpr std::size_t side_by_side = 16;
  void find_buckets(std::span<const Bounds3f> boxes, std::uint32_t* out) const {
    while (!boxes.empty()) {
      const std::size_t count = std::min(boxes.size(), side_by_side);
      alignas(16) float centre[side_by_side][4];
      std::uint32_t at[side_by_side] = {};
      for (std::size_t k = 0; k < count; ++k)
        *reinterpret_cast<Float4InMemory*>(centre[k]) = record_of(boxes[k], 0).centre();
      for (int i = 0; i < levels; ++i)
        for (std::size_t k = 0; k < count; ++k) {
          const Node& node = nodes[at[k]];
          at[k] = node.child[!(centre[k][node.split.axis] < node.split.at)];
        }
      for (std::size_t k = 0; k < count; ++k) *out++ = nodes[at[k]].bucket;
      boxes = boxes.subspan(count);
    }
  }

  std::uint32_t grow(std::span<BoxRecord> sample, BoxRecord* spare, int level) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({{}, {index, index}, 0});
    levels = std::max(levels, level);
    std::optional<SahSplit> split;
    std::size_t boxes = 0;
    WideBounds centres;
    for (const BoxRecord& r : sample) {
      boxes += r.reference;
      centres.extend(r.centre(), r.centre());
    }
    if (boxes > bucket_size && sample.size() > least_samples && level < most_bucket_levels)
      split = choose_split(sample, centres, 1, true);
    if (!split) {
      nodes[index].bucket = buckets++;
      return index;
    }
    nodes[index].split = *split;
    const std::size_t below = partition(sample, spare, *split);
    const std::uint32_t low = grow({spare, below}, sample.data(), level + 1);
    const std::uint32_t high = grow({spare + below, sample.size() - below}, sample.data() + below, level + 1);
    nodes[index].child[0] = low;
    nodes[index].child[1] = high;
    return index;
  }
};

// A sixteenth of the boxes is about as large or larger.
float large_area(std::span<const Bounds3f> boxes) {
  constexpr std::size_t chosen = 1024;
  std::array<float, chosen> area;
  for (std::size_t i = 0; i < chosen; ++i) area[i] = surface_area(boxes[mixed(3, i) % boxes.size()]);
  std::ranges::nth_element(area, area.end() - chosen / 16);
  return area[chosen - chosen / 16];
}

// From all large boxes, one of which can spoil a node, and some of the others, which count for the rest.
Top top_of(std::span<const Bounds3f> boxes) {
  std::vector<BoxRecord> sample;
  if (boxes.size() > bucket_size) {
    const float large = large_area(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (surface_area(boxes[i]) > large)
        sample.push_back(record_of(boxes[i], 1));
      else if (mixed(4, i) % sampling == 0)
        sample.push_back(record_of(boxes[i], sampling));
  }
  Top top;
  std::vector<BoxRecord> spare(sample.size());
  top.grow(sample, spare.data(), 0);
  return top;
}

// The boxes in order of their buckets; those of bucket i begin at starts[i].
std::unique_ptr<BoxRecord[]> sort_into_buckets(std::span<const Bounds3f> boxes, const Top& top,
                                               std::vector<std::size_t>& starts) {
  constexpr std::size_t block_size = 65536;
  const std::size_t blocks = (boxes.size() + block_size - 1) / block_size;
  auto sorted = std::make_unique_for_overwrite<BoxRecord[]>(boxes.size());
  prefer_huge_pages(sorted.get(), boxes.size());
  const auto bucket = std::make_unique_for_overwrite<std::uint32_t[]>(boxes.size());
  std::vector<std::vector<std::size_t>> at(blocks, std::vector<std::size_t>(top.buckets));
  const auto in_blocks = [&](const auto& visit) {
    for_all(blocks, [&](std::size_t block) {
      const std::size_t begin = block * block_size;
      visit(begin, std::min(boxes.size(), begin + block_size), at[block]);
    });
  };
  in_blocks([&](std::size_t begin, std::size_t end, std::vector<std::size_t>& count) {
    top.find_buckets(boxes.subspan(begin, end - begin), &bucket[begin]);
    for (std::size_t i = begin; i < end; ++i) ++count[bucket[i]];
  });
  std::size_t before = 0;
  for (std::size_t b = 0; b < top.buckets; ++b) {
    starts.push_back(before);
    for (std::size_t block = 0; block < blocks; ++block) before += std::exchange(at[block][b], before);
  }
  starts.push_back(before);
  in_blocks([&](std::size_t begin, std::size_t end, std::vector<std::size_t>& next) {
    for (std::size_t i = begin; i < end; ++i) sorted[next[bucket[i]]++] = record_of(boxes[i], i);
  });
  return sorted;
}

struct Built {
  std::uint32_t node = 0;
  Costs costs{};
  bool empty = false;
};

// Puts inner nodes above the buckets, from `next` on.
Built join(const Top& top, std::uint32_t at, std::span<const Built> buckets, BinaryNode* nodes,
           std::uint32_t& next) {
  if (top.is_bucket(at)) return buckets[top.nodes[at].bucket];
  const Built low = join(top, top.nodes[at].child[0], buckets, nodes, next);
  const Built high = join(top, top.nodes[at].child[1], buckets, nodes, next);
  if (low.empty) return high;
  if (high.empty) return low;
  Built built;
  built.node = next++;
  BinaryNode& node = nodes[built.node];
  node.child[0] = low.node, node.child[1] = high.node;
  node.lower = min(nodes[low.node].lower, nodes[high.node].lower);
  node.upper = max(nodes[low.node].upper, nodes[high.node].upper);
  built.costs = plan_wide_node(node, low.costs, high.costs);
  return built;
}

}  // namespace

BinaryTree build_binary_tree(std::span<const Bounds3f> boxes, unsigned leaf_size) {
  const Top top = top_of(boxes);
  std::vector<std::size_t> starts;
  const auto sorted = sort_into_buckets(boxes, top, starts);
  BinaryTree tree;
  tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(2 * boxes.size() + top.nodes.size());
  tree.order = std::make_unique_for_overwrite<std::uint32_t[]>(boxes.size());
  std::vector<Built> built(top.buckets);
  for_all(built.size(), [&](std::size_t b) {
    const std::size_t size = starts[b + 1] - starts[b];
    built[b].node = static_cast<std::uint32_t>(2 * starts[b]);
    built[b].empty = size == 0;
    if (size == 0) return;
    const auto spare = std::make_unique_for_overwrite<BoxRecord[]>(size);
    built[b].costs = BucketBuilder(leaf_size, tree.nodes.get(), built[b].node, tree.order.get())
                         .build({&sorted[starts[b]], size}, spare.get(),
                                static_cast<std::uint32_t>(starts[b]), top.levels);
  });
  auto next = static_cast<std::uint32_t>(2 * boxes.size());
  tree.root = join(top, 0, built, tree.nodes.get(), next).node;
  return tree;
}

}  // namespace vitrail
