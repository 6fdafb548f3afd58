// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "farm/files/timeline.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Writes what all ranks did into one file. All ranks call it, when no ray is alive; rank 0 writes their
// timelines in turn. `origin` is rank 0's, where the file's time begins.
void write_timelines(Transport& transport, const Timeline& mine, int workers,
                     Timeline::Clock::time_point origin, const std::filesystem::path& file);

}  // namespace vitrail
