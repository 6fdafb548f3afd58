// SPDX-License-Identifier: Apache-2.0
// Where the nodes of a glTF file stand.
#pragma once

#include <vector>

#include "importers/gltf/read/document.h"
#include "scene/geometry/transform.h"

namespace vitrail::gltf {

struct NodeTree {
  // Of every node, in the world. Throws Error with the node's place: one with two parents, or its own
  // ancestor, a child that is not there, numbers that are not finite or of a wrong count.
  explicit NodeTree(const Document& document);

  std::vector<Transform> to_world;
  std::vector<int> shown;  // nodes of the scene that is shown, each before its children
};

// T·R·S or the matrix of a node, in its parent's space.
Transform local_transform(const Document& document, int node);
// Of a translation, a rotation (quaternion x y z w, of any length) and a scale.
Transform trs(const double* translation, const double* rotation, const double* scale);

}  // namespace vitrail::gltf
