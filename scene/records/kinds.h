// SPDX-License-Identifier: Apache-2.0
// These functions name the alternatives of the scene's variants for people.
#pragma once

#include "scene/records/camera.h"
#include "scene/records/light.h"
#include "scene/records/material.h"
#include "scene/records/texture.h"
#include "scene/shapes/quadric.h"

namespace vitrail {

// Returns the name that `inspect` shows: "tabulated", "diffuse", "point" …
const char* kind_of(const Spectrum& spectrum);
const char* kind_of(const TextureModel& model);
const char* kind_of(const MaterialModel& model);
const char* kind_of(const LightModel& model);
const char* kind_of(const Camera& camera);
const char* kind_of(QuadricKind kind);

}  // namespace vitrail
