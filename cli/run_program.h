// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

// The folder of the running program: the others lie beside it.
std::filesystem::path program_folder();

// Runs a program of the suite and waits. If it ends with another status than 0, throws Error (status 3) or
// MachineError: it has said itself what was wrong. It is terminated once `stopped()`. If INT or TERM ended
// it, throws Interrupted.
void run_program(const std::string& name, const std::vector<std::string>& arguments,
                 bool (*stopped)() = nullptr);

}  // namespace vitrail
