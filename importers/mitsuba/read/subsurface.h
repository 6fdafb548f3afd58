// SPDX-License-Identifier: Apache-2.0
// Mitsuba 0.6 describes the insides of things by these objects.
#pragma once

#include <optional>

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Returns the coefficients of the measured medium that "material" names, "Skin1" where it names none; per
// unit of the scene's length a hundred times what is measured per mm.
AbsorptionScattering measured_coefficients(Builder& builder, const Object& object);

// Returns the material of a shape that has a <subsurface> inside of its surface, which is of the material
// `surface`; nothing where it has none.
std::optional<Id<Material>> subsurface_material(Builder& builder, const Object& shape, Id<Material> surface);

}  // namespace vitrail::mitsuba
