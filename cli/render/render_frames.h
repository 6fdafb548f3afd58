// SPDX-License-Identifier: Apache-2.0
// This renders many pictures of one bundle by one command, or by several that share the list.
#pragma once

#include <span>

#include "cli/render/render_arguments.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Renders each frame of --frames that is missing, on all ranks together. The whole list is checked first. A
// frame that fails is passed by; the exit status, which is returned, is that of the first. A frame that
// another process renders is passed by, too; at the end this one waits for it, and takes it over where that
// process ends before. `typed` has the command's words.
int render_frames(Transport& transport, const RenderArguments& command, std::span<char* const> typed);

}  // namespace vitrail
