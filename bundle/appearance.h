// SPDX-License-Identifier: Apache-2.0
// What the renderer shows: the materials, lights and cameras that a scene's own (scene/material.h,
// scene/light.h) are reduced to when it is partitioned. Their spectra are `resolved`.
#pragma once

#include <variant>

#include "scene/camera.h"
#include "scene/spectrum.h"
#include "scene/vec.h"

namespace vitrail::bundle {

// Lambertian on both sides: f = reflectance/π.
struct DiffuseMaterial {
  Spectrum reflectance = ConstantSpectrum{0.5f};
  bool operator==(const DiffuseMaterial&) const = default;
};

// Smooth interface; eta(λ) is the index of the medium behind over that of the one in front.
struct DielectricMaterial {
  Spectrum eta = ConstantSpectrum{1.5f};
  bool operator==(const DielectricMaterial&) const = default;
};

// No interface at all: rays go through unchanged.
struct InterfaceMaterial {
  bool operator==(const InterfaceMaterial&) const = default;
};

using Material = std::variant<DiffuseMaterial, DielectricMaterial, InterfaceMaterial>;

// Emission of a surface: radiance, W·m⁻²·sr⁻¹·nm⁻¹, from its front side or from both.
struct AreaLight {
  Spectrum radiance;
  bool two_sided = false;
  bool operator==(const AreaLight&) const = default;
};

// Radiant intensity, W·sr⁻¹·nm⁻¹, equal in all directions.
struct PointLight {
  Point3d position;
  Spectrum intensity;
  bool operator==(const PointLight&) const = default;
};

// Irradiance on a plane across `direction` (unit, the way the light travels), W·m⁻²·nm⁻¹.
struct DistantLight {
  Vector3d direction;
  Spectrum irradiance;
  bool operator==(const DistantLight&) const = default;
};

// Constant radiance from everywhere around the scene.
struct InfiniteLight {
  Spectrum radiance;
  bool operator==(const InfiniteLight&) const = default;
};

using Light = std::variant<PointLight, DistantLight, InfiniteLight>;

using Camera = vitrail::Camera;

}  // namespace vitrail::bundle
