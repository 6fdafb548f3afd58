// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/read/builder.h"

namespace vitrail::mitsuba {

// Makes lights without extent as bright as Mitsuba's "direct" shows them: it adds up its emitter_samples of
// such a light and does not divide by their number (measured with 3.9.1). A point light is 4 times as bright
// with 4 samples. Lamps, constant light and maps are not concerned. `root` is the <scene>, whose lights have
// been read.
void multiply_by_samples(Builder& builder, const Object& root);

}  // namespace vitrail::mitsuba
