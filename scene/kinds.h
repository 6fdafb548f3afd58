// SPDX-License-Identifier: Apache-2.0
// What people call the alternatives of the scene's variants.
#pragma once

#include "scene/camera.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/quadric.h"
#include "scene/texture.h"

namespace vitrail {

const char* kind_of(const Spectrum& spectrum);
const char* kind_of(const TextureModel& model);
const char* kind_of(const MaterialModel& model);
const char* kind_of(const LightModel& model);
const char* kind_of(const Camera& camera);
const char* kind_of(QuadricKind kind);

}  // namespace vitrail
