// SPDX-License-Identifier: Apache-2.0
// These functions read KHR_lights_punctual and cameras.
#pragma once

#include "importers/gltf/read/document.h"
#include "scene/geometry/transform.h"

namespace vitrail::gltf {

// Adds the light of that node, if it has one, in candela or lux (units.h); a node's scale does not count.
void add_light(const Document& document, int node, const Transform& to_world, ImportedScene& imported);

// Takes the camera of that node, and a film of its proportions: 1280 pixels on the longer side.
void take_camera(const Document& document, int node, const Transform& to_world, ImportedScene& imported);

}  // namespace vitrail::gltf
