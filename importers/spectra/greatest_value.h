// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/records/scene.h"

namespace vitrail {

// At any wavelength; of a texture, what is likely.
double greatest_value(const SpectrumParameter& parameter);

}  // namespace vitrail
