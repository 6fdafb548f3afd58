// SPDX-License-Identifier: Apache-2.0
// Running the programs as a user does.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace vitrail::test {

struct CommandResult {
  int status = -1;     // exit status; 128 + signal where one ended it
  std::string output;  // standard output and error together
};

// Through the shell.
CommandResult run(const std::string& command);

// "…/vitrail VERB", quoted for the shell.
std::string vitrail(const std::string& verb);
// The same under mpirun with what it needs to run as root and oversubscribed.
std::string mpi_vitrail(const std::string& verb, int ranks);

nlohmann::json read_json(const std::filesystem::path& file);

// The corpus of foreign scenes: VITRAIL_CORPUS, else ../shared/corpus beside the source; empty where there is
// none.
std::filesystem::path corpus();

}  // namespace vitrail::test
