// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "partitioner/partition.h"

namespace vitrail {

// Writes one flat JSON object: `partition --stats`.
void write_stats(const std::filesystem::path& file, const PartitionStats& stats);

// Prints what a user reads at the end.
void print_summary(const PartitionStats& stats, const std::filesystem::path& bundle);

}  // namespace vitrail
