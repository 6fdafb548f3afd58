// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/context.h"
#include "importers/povray/write/write_meshes.h"
#include "importers/writing/placed_quadric.h"

namespace vitrail::povray {

namespace {

// In the quadric's own space; "" for what POV-Ray does not have.
std::string object_of(const Quadric& q) {
  if (q.kind == QuadricKind::disk && is_whole_turn(q)) return fmt::format("disc {{\nz*0, z, 1, {}", q.low);
  if (!is_whole(q)) return "";
  switch (q.kind) {
    case QuadricKind::sphere:
      return "sphere {\nz*0, 1";
    case QuadricKind::cylinder:
      return "cylinder {\nz*0, z, 1 open";
    case QuadricKind::cone:
      return "cone {\nz*0, 1, z, 0 open";
    default:
      return "";
  }
}

}  // namespace

std::string quadric_text(const MeshText& text) {
  std::string object = object_of(*text.mesh.quadric);
  if (object.empty() || text.with_uvs || !is_invertible(text.to_pov)) return "";
  object += "\n" + matrix(text.to_pov) + "\n";
  // A mirror leaves POV-Ray's outside where it was.
  if (text.flip != swaps_handedness(text.to_pov)) object += "inverse\n";
  return object;
}

}  // namespace vitrail::povray
