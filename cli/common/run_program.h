// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

// Returns the folder of the running program: the others lie beside it.
std::filesystem::path program_folder();

// Runs a program of the suite and waits. Returns exit_done, or exit_differs of `compare` and `convert
// --check`. If it ends with another status, throws Error or MachineError that is AlreadySaid too
// (main_guard.h). It is terminated once `stopped()`. If INT or TERM ended it, throws Interrupted.
int run_program(const std::string& name, const std::vector<std::string>& arguments,
                bool (*stopped)() = nullptr, const std::filesystem::path& standard_output = {});

// A ForeignEnd is the end of a program that others wrote.
struct ForeignEnd {
  bool found = false;  // it is on the path
  int status = 0;      // 128 + signal where one ended it
};
// Runs one and waits: words[0] is looked for on the path. The program's words go into the two files.
ForeignEnd run_foreign(const std::vector<std::string>& words, const std::filesystem::path& standard_output,
                       const std::filesystem::path& standard_error);

}  // namespace vitrail
