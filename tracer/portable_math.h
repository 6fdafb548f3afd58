// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/portable_math.h"
