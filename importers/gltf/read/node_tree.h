// SPDX-License-Identifier: Apache-2.0
// A NodeTree places the nodes of a glTF file.
#pragma once

#include <vector>

#include "importers/gltf/read/document.h"
#include "scene/geometry/transform.h"

namespace vitrail::gltf {

struct NodeTree {
  // Finds the place of every node, in the world. Throws Error with the node's place: a node has two parents,
  // or is its own ancestor, a child is not there, numbers are not finite or of a wrong count.
  explicit NodeTree(const Document& document);

  std::vector<Transform> to_world;
  std::vector<int> shown;  // nodes of the scene that is shown, each before its children
};

// Returns T·R·S or the matrix of a node, in its parent's space.
Transform local_transform(const Document& document, int node);
// Returns the transform of a translation, a rotation (quaternion x y z w, of any length) and a scale.
Transform trs(const double* translation, const double* rotation, const double* scale);

}  // namespace vitrail::gltf
