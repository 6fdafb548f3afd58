// SPDX-License-Identifier: Apache-2.0
// BSDFs with many parameters, in files of their own.
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// principled, principledthin.
MaterialModel principled(Builder& builder, const Object& bsdf);
// 0.6's Hanrahan and Krueger: of the measured media it takes the first by default.
MaterialModel slab(Builder& builder, const Object& bsdf);

}  // namespace vitrail::mitsuba
