// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/textures.h"
