// SPDX-License-Identifier: Apache-2.0
#include "cli/common/quadric_counts.h"

#include <fmt/format.h>

#include <map>

#include "scene/records/kinds.h"

namespace vitrail {

std::string quadric_counts(const Scene& scene) {
  std::map<QuadricKind, std::size_t> counts;
  const auto add = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes)
      if (const auto& quadric = scene.meshes[shape.mesh.value].quadric) ++counts[quadric->kind];
  };
  add(scene.shapes);
  for (const Prototype& prototype : scene.prototypes) add(prototype.shapes);
  std::string text;
  for (const auto& [kind, count] : counts)
    text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, kind_of(kind), count == 1 ? "" : "s");
  return text.empty() ? "none" : text;
}

}  // namespace vitrail
