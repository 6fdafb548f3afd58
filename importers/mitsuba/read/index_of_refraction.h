// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Returns the property as a number, or by the name of a substance; `otherwise` names the one where it is
// absent.
float index_of(Builder& builder, const Object& object, const char* name, const char* otherwise);

// Returns the mean reflectance of a smooth interface for diffuse light from within, 2∫F(μ)μ dμ; eta is the
// index within / outside.
double internal_reflectance(double eta);

}  // namespace vitrail::mitsuba
