// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "farm/transport/transport.h"

namespace vitrail {

// Gives all ranks the text that rank 0 has. All of them call it.
void share_from_root(Transport& transport, std::string& text);

}  // namespace vitrail
