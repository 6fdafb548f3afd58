// SPDX-License-Identifier: Apache-2.0
// These functions write the camera and the lights of a glTF.
#pragma once

#include "importers/gltf/tinygltf.h"
#include "importers/writing/conversion_notes.h"

namespace vitrail::gltf {

// Returns whether the camera mirrors its picture. glTF's cameras cannot do that: all is then written
// mirrored.
bool is_mirrored(const Camera& camera);

tinygltf::Node node_at(const Transform& to_parent);

// Each adds a node to the model and gives its index, or −1 where glTF has no such thing. `mirror` goes from
// the Scene's world to the file's.
int write_camera(tinygltf::Model& model, ConversionNotes& notes, const Transform& mirror);
int write_light(tinygltf::Model& model, ConversionNotes& notes, const Scene& scene, const Light& light,
                const Transform& mirror);

}  // namespace vitrail::gltf
