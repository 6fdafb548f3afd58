// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>

namespace vitrail {

// Declares --memory of a program that runs within_memory.
void declare_memory(CLI::App& app, std::string& memory);

// Returns the bytes that a program may take: those asked for, or the share of what the
// job has (scene/system/machine_limits.h). It says that share unless `quiet` or where it
// is the machine's. Throws UsageError.
std::uint64_t memory_budget(const std::string& asked, bool quiet);

}  // namespace vitrail
