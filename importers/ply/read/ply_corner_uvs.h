// SPDX-License-Identifier: Apache-2.0
// MeshLab writes texture coordinates of the corners of faces: a list "texcoord", two numbers a
// corner.
#pragma once

#include <optional>

#include "importers/ply/read/ply_body.h"

namespace vitrail::ply {

// Returns the property of the faces' element; nothing where the file has none, or has (u,v) of vertices or
// strips.
std::optional<std::size_t> corner_uvs_of(const Header& header, const BodyPlan& plan);

// Gives (u,v) to the mesh that was read from the same body. A vertex whose corners differ in theirs becomes
// several, with its attributes. Faces whose list has another length have (0,0).
void read_corner_uvs(const InputBytes& bytes, const TextCursor& cursor, const Header& header,
                     const BodyPlan& plan, std::size_t property, Body& body);

}  // namespace vitrail::ply
