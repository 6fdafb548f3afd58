// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/node_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrail::gltf {

Transform trs(const double* t, const double* q, const double* s) {
  const double length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const double n = length2 > 0 ? 2 / length2 : 0;
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Transform m;
  m.m[0] = {(1 - n * (y * y + z * z)) * s[0], n * (x * y - z * w) * s[1], n * (x * z + y * w) * s[2], t[0]};
  m.m[1] = {n * (x * y + z * w) * s[0], (1 - n * (x * x + z * z)) * s[1], n * (y * z - x * w) * s[2], t[1]};
  m.m[2] = {n * (x * z - y * w) * s[0], n * (y * z + x * w) * s[1], (1 - n * (x * x + y * y)) * s[2], t[2]};
  return m;
}

Transform local_transform(const Document& document, int index) {
  const tinygltf::Node& node = document.model().nodes[static_cast<std::size_t>(index)];
  const auto checked = [&](const std::vector<double>& given, std::vector<double> otherwise,
                           const char* name) {
    if (given.empty()) return otherwise;
    if (given.size() != otherwise.size())
      document.fail("nodes", index,
                    fmt::format("{} has {} numbers instead of {}", name, given.size(), otherwise.size()));
    if (!std::ranges::all_of(given, [](double v) { return std::isfinite(v); }))
      document.fail("nodes", index, fmt::format("{} is not finite", name));
    return given;
  };
  if (!node.matrix.empty()) {
    const std::vector<double> m = checked(node.matrix, std::vector<double>(16), "matrix");
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
      document.fail("nodes", index, "its matrix is not affine");
    Transform t;
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column) t.m[row][column] = m[4 * column + row];
    return t;
  }
  return trs(checked(node.translation, {0, 0, 0}, "translation").data(),
             checked(node.rotation, {0, 0, 0, 1}, "rotation").data(),
             checked(node.scale, {1, 1, 1}, "scale").data());
}

NodeTree::NodeTree(const Document& document) {
  const auto& nodes = document.model().nodes;
  const int count = static_cast<int>(nodes.size());
  std::vector<int> parent(nodes.size(), -1);
  for (int i = 0; i < count; ++i)
    for (const int child : nodes[static_cast<std::size_t>(i)].children) {
      document.element(nodes, child, "nodes", "nodes", i);
      int& of_child = parent[static_cast<std::size_t>(child)];
      if (of_child >= 0)
        document.fail("nodes", child, fmt::format("is a child of nodes[{}] and nodes[{}]", of_child, i));
      of_child = i;
    }
  // Parents before their children; what is never reached is its own ancestor.
  std::vector<int> order;
  for (int i = 0; i < count; ++i)
    if (parent[static_cast<std::size_t>(i)] < 0) order.push_back(i);
  to_world.resize(nodes.size());
  std::vector<bool> reached(nodes.size());
  for (std::size_t at = 0; at < order.size(); ++at) {
    const int i = order[at], up = parent[static_cast<std::size_t>(i)];
    reached[static_cast<std::size_t>(i)] = true;
    Transform t = local_transform(document, i);
    if (up >= 0) t = to_world[static_cast<std::size_t>(up)] * t;
    for (const auto& row : t.m)
      if (!std::ranges::all_of(row, [](double v) { return std::isfinite(v); }))
        document.fail("nodes", i, "its place in the world is not finite");
    to_world[static_cast<std::size_t>(i)] = t;
    for (const int child : nodes[static_cast<std::size_t>(i)].children) order.push_back(child);
  }
  if (const auto lost = std::ranges::find(reached, false); lost != reached.end())
    document.fail("nodes", static_cast<int>(lost - reached.begin()), "is its own ancestor");

  const tinygltf::Model& model = document.model();
  if (model.scenes.empty()) {
    shown = order;
    return;
  }
  const int scene = std::max(model.defaultScene, 0);
  std::vector<int> stack;
  for (const int root : document.element(model.scenes, scene, "scenes", "scenes", scene).nodes) {
    document.element(nodes, root, "nodes", "scenes", scene);
    stack.push_back(root);
  }
  std::ranges::reverse(stack);
  std::vector<bool> is_shown(nodes.size());
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    if (is_shown[static_cast<std::size_t>(i)]) continue;  // named twice
    is_shown[static_cast<std::size_t>(i)] = true;
    shown.push_back(i);
    const auto& children = nodes[static_cast<std::size_t>(i)].children;
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
}

}  // namespace vitrail::gltf
