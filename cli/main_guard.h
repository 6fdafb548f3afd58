// SPDX-License-Identifier: Apache-2.0
// Where every program catches what it could not handle: one message on stderr and the exit status that says
// who has to act.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace vitrail {

// The exit status of every program.
inline constexpr int exit_done = 0, exit_differs = 1, exit_usage = 2, exit_bad_input = 3, exit_machine = 4;

// Runs `body` and returns its status. What it throws is printed as "vitrail: place: message" and the excerpt:
// Error → 3, MachineError → 4, UsageError and CLI::ParseError → 2, any other exception → 4.
int run_guarded(const std::function<int()>& body);

// Parses the command line before it runs `body`: --help prints the help (0), a wrong line says what is wrong
// (2).
int run_guarded(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

}  // namespace vitrail
