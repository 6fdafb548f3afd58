// SPDX-License-Identifier: Apache-2.0
// An FBX file, text or binary, has facts that assimp does not hand on.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace vitrail::assimp {

struct FbxFacts {
  // They are the names of the nodes that cameras and lights look at (3ds Max), by the names of their own
  // nodes.
  std::map<std::string, std::string> targets;
  bool has_orthographic_camera = false;
  bool has_vertical_angles = false;  // the field of view of the last camera is that of the height
};
FbxFacts fbx_facts(std::string_view bytes);

}  // namespace vitrail::assimp
