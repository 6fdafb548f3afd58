// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// Returns the greatest value at any wavelength; of a texture, which is not read, a likely value.
double greatest_value(const SpectrumParameter& parameter);

}  // namespace vitrail
