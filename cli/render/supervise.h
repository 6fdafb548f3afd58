// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

// Steps are the file that a render writes with each step that is kept of it, and the name of such a step.
struct Steps {
  std::filesystem::path file;
  const char* name;
};

// Runs a render, mpirun's or its own. Starts it again where it was killed or the machine failed
// it, at most `restarts` times, after 1, 2, 4 … 60 s: it goes on from its checkpoint. It is not
// started again if it is done, used wrongly, given bad input or told to stop. TERM, INT and
// USR1 are passed on. A launcher that goes on `patience_s` after the process with the lock of
// `film` is killed. So is that process where it was stopped for twice as long; 0: never. A
// launcher that fails twice, in its own words, before a render has begun, is not started again.
// It says how a render ended, how often in a row without one of `steps`, and that it gives up.
// Returns the last exit status, 128 + the signal's number where one ended it.
int supervise(const std::vector<std::string>& command, const std::filesystem::path& film, const Steps& steps,
              int restarts, double patience_s);

// Returns the words of this command line without the supervisor's own options, after those of `launcher`.
std::vector<std::string> supervised_command(int argc, char** argv, const std::string& launcher);

}  // namespace vitrail
