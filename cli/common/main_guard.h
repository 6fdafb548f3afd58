// SPDX-License-Identifier: Apache-2.0
// Every program catches here what it could not handle. It writes one message on stderr and ends with the exit
// status that says who has to act.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "scene/system/diagnostics.h"

namespace vitrail {

// These are the exit statuses of every program.
inline constexpr int exit_done = 0, exit_differs = 1, exit_usage = 2, exit_bad_input = 3, exit_machine = 4;

// A signal asked for an end, and all work under way is in order. The exit status is 128 + its number, as a
// shell has it of a program that the signal ended.
struct Interrupted : std::runtime_error {
  Interrupted(int number, const std::string& message) : std::runtime_error(message), signal(number) {}
  int signal;
};

// Another program of the suite ended with that status, and has said itself why: nothing is added.
struct AlreadySaid {
  int status;
};
struct RefusalAlreadySaid : Error, AlreadySaid {
  RefusalAlreadySaid(const std::string& program, int with)
      : Error(program + " refused its input"), AlreadySaid{with} {}
};
struct FailureAlreadySaid : MachineError, AlreadySaid {
  FailureAlreadySaid(const std::string& program, int with)
      : MachineError(program + " failed"), AlreadySaid{with} {}
};

// Ends main. It dies of the signal that such a status speaks of, because shells end a loop or a list only
// where a program did. Returns any other status.
int end_with(int status);

// Runs `body` and returns its status. It prints what `body` throws as "vitrail: place: message" and the
// excerpt: Error → 3, MachineError → 4, UsageError and CLI::ParseError → 2, Interrupted → 128 + the signal's
// number. Other exceptions about a file (of JSON, of names, of lengths) → 3, the rest → 4. Standard output
// that could not be written → 4.
int run_guarded(const std::function<int()>& body);

// Parses the command line before it runs `body`: --help prints the help (0), a wrong
// line says what is wrong (2).
int run_guarded(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

}  // namespace vitrail
