// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/kd_plan.h"

#include <tbb/parallel_invoke.h>

#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include "partitioner/cutting/add_node.h"
#include "partitioner/cutting/choose_plane.h"

namespace vitrail {

namespace {

// No domain should have more than this many times its even share of triangles.
constexpr double most_load = 1.2;
// A cell stays whole that has so many times its share of items and so many for each of its domains; both are
// far from what meshes come to that have many triangles in a domain.
constexpr double most_pieces = 8, few_items = 64;

Cut choose(std::span<const Item> sample, const Subtree& s, const PlanRule& rule) {
  const double spare = most_load * rule.share * s.domains / std::max(1.0, static_cast<double>(sample.size()));
  Division division{s.domains, std::min(s.domains / 2, (rule.most_domains + 1) / 2), 0};
  // A side of so many domains must not need more levels than are left.
  const int levels = max_kd_depth - 1 - s.depth;
  if (levels < 31 && s.domains > 1u << levels)
    division.least = std::max(division.least, s.domains - (1u << levels));
  division.tolerance = std::max(0.01, std::pow(spare, 1.0 / std::bit_width(s.domains - 1)) - 1);
  if (const auto cut = rule.median ? median_plane(sample, division) : choose_plane(sample, division))
    return *cut;
  if (s.cell.empty()) return {{}, s.domains / 2};
  const Vector3f e = extent(s.cell);
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  return {{axis, std::midpoint(s.cell.lower[axis], s.cell.upper[axis])}, s.domains / 2};
}

struct Halves {
  std::vector<Item> below, above;
};

// What is cut keeps the rest of its box on either side.
Halves halves(const std::vector<Item>& sample, Plane plane) {
  Halves h;
  for (const Item& item : sample) {
    const AxisExtent i{item.bounds.lower[plane.axis], item.bounds.upper[plane.axis]};
    const bool in_both = reaches_above(i, plane.split) && reaches_below(i, plane.split);
    if (reaches_below(i, plane.split)) {
      h.below.push_back(item);
      if (in_both) h.below.back().bounds.upper[plane.axis] = plane.split;
    }
    if (reaches_above(i, plane.split)) {
      h.above.push_back(item);
      if (in_both) h.above.back().bounds.lower[plane.axis] = plane.split;
    }
  }
  return h;
}

// Whether the plane cuts more than it parts, of items that have been cut again and again.
bool parts_nothing(const Subtree& s, const PlanRule& rule, std::size_t items, const Halves& h) {
  const auto n = static_cast<double>(items);
  const double cut = static_cast<double>(h.below.size() + h.above.size()) - n;
  return cut > n / 2 && n > most_pieces * rule.share * s.domains && n > few_items * rule.rate * s.domains;
}

std::uint32_t child_of(const Subtree& s) {
  return s.domains == 1 ? KdNode::leaf_bit | s.first_domain : s.node;
}

// The plan below a node: its own numbers begin at 0.
void append(KdPlan& plan, const KdPlan& part) {
  const auto nodes = static_cast<std::uint32_t>(plan.nodes.size());
  const auto leaves = static_cast<std::uint32_t>(plan.leaves.size());
  for (KdNode node : part.nodes) {
    for (std::uint32_t* child : {&node.below, &node.above})
      *child += *child & KdNode::leaf_bit ? leaves : nodes;
    plan.nodes.push_back(node);
  }
  plan.leaves.insert(plan.leaves.end(), part.leaves.begin(), part.leaves.end());
  plan.samples.insert(plan.samples.end(), part.samples.begin(), part.samples.end());
}

}  // namespace

KdPlan plan_kd_tree(std::vector<Item> sample, const Subtree& s, const PlanRule& rule,
                    std::span<KdNode> kd_nodes) {
  if (s.domains <= rule.most_domains) return {{}, {s}, {sample.size()}};
  const auto [plane, domains_below] = choose(sample, s, rule);
  Subtree low{s.cell, s.node + 1, s.first_domain, domains_below, s.depth + 1};
  Subtree high{s.cell, s.node + domains_below, s.first_domain + domains_below, s.domains - domains_below,
               s.depth + 1};
  low.cell.upper[plane.axis] = high.cell.lower[plane.axis] = plane.split;
  const auto axis = static_cast<std::uint32_t>(plane.axis);
  const std::size_t items = sample.size();
  Halves half_samples = halves(sample, plane);
  sample = {};  // its memory is the halves' now
  if (parts_nothing(s, rule, items, half_samples)) {
    const std::uint32_t whole = KdNode::leaf_bit | s.first_domain;
    kd_nodes[s.node] = {plane.split, axis, whole, whole};
    return {{}, {s}, {items}};
  }
  kd_nodes[s.node] = {plane.split, axis, child_of(low), child_of(high)};
  KdPlan below, above;
  tbb::parallel_invoke([&] { below = plan_kd_tree(std::move(half_samples.below), low, rule, kd_nodes); },
                       [&] { above = plan_kd_tree(std::move(half_samples.above), high, rule, kd_nodes); });
  const auto leaves = static_cast<std::uint32_t>(below.leaves.size());
  const auto first_above = static_cast<std::uint32_t>(1 + below.nodes.size());
  KdPlan plan{{{plane.split, axis, below.nodes.empty() ? KdNode::leaf_bit : 1,
                above.nodes.empty() ? KdNode::leaf_bit | leaves : first_above}},
              {},
              {}};
  append(plan, below);
  append(plan, above);
  return plan;
}

namespace {

// The tree with the domains that there are, as numbers of old.
class FinalTree {
 public:
  FinalTree(std::span<const KdNode> planned, const std::vector<SharedCell>& shared) : planned_(planned) {
    for (const SharedCell& cell : shared) shared_[cell.domain] = &cell;
    add(planned.empty() ? KdNode::leaf_bit : 0);
  }
  std::vector<KdNode> nodes;
  std::vector<std::uint32_t> domains;  // the old number of each

 private:
  // Each returns the number of the child in this tree.
  std::uint32_t add(std::uint32_t child) {
    if (!(child & KdNode::leaf_bit) && planned_[child].below == planned_[child].above)
      child = planned_[child].below;
    if (!(child & KdNode::leaf_bit)) {
      const KdNode& planned = planned_[child];
      return add_node(
          nodes, planned, [&] { return add(planned.below); }, [&] { return add(planned.above); });
    }
    const std::uint32_t domain = child & ~KdNode::leaf_bit;
    const auto found = shared_.find(domain);
    if (found == shared_.end()) return leaf(domain);
    const SharedCell& cell = *found->second;
    // Exact: there are fewer than 2²⁴.
    const auto sharers = static_cast<float>(1 + cell.numbers.size());
    return add_node(
        nodes, {sharers, KdNode::no_axis}, [&] { return leaf(domain); },
        [&] { return add_shared(cell, cell.tree.empty() ? KdNode::leaf_bit : 0); });
  }
  std::uint32_t add_shared(const SharedCell& cell, std::uint32_t child) {
    if (child & KdNode::leaf_bit) {
      const std::uint32_t other = child & ~KdNode::leaf_bit;
      return leaf(other < cell.numbers.size() ? cell.numbers[other] : cell.domain);
    }
    const KdNode& node = cell.tree[child];
    return add_node(
        nodes, node, [&] { return add_shared(cell, node.below); },
        [&] { return add_shared(cell, node.above); });
  }
  // A domain of a shared cell may be met in several places.
  std::uint32_t leaf(std::uint32_t domain) {
    const auto [found, is_new] = numbers_.emplace(domain, static_cast<std::uint32_t>(domains.size()));
    if (is_new) domains.push_back(domain);
    return KdNode::leaf_bit | found->second;
  }

  std::span<const KdNode> planned_;
  std::map<std::uint32_t, const SharedCell*> shared_;  // by domain
  std::map<std::uint32_t, std::uint32_t> numbers_;     // by the old number
};

}  // namespace

std::vector<std::uint32_t> number_domains(Manifest& manifest, std::vector<SharedCell> shared) {
  FinalTree tree(manifest.kd_nodes, shared);
  std::map<std::uint32_t, DomainInfo*> beyond;  // by number
  for (SharedCell& cell : shared)
    for (std::size_t i = 0; i < cell.numbers.size(); ++i) beyond[cell.numbers[i]] = &cell.infos[i];
  std::vector<DomainInfo> domains;
  for (const std::uint32_t old : tree.domains)
    domains.push_back(std::move(old < manifest.domains.size() ? manifest.domains[old] : *beyond.at(old)));
  manifest.domains = std::move(domains);
  manifest.kd_nodes = std::move(tree.nodes);
  return tree.domains;
}

}  // namespace vitrail
