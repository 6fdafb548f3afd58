// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "farm/transport/transport.h"

namespace vitrail {

// The text that rank 0 has, on all ranks. All of them call it.
void share_from_root(Transport& transport, std::string& text);

}  // namespace vitrail
