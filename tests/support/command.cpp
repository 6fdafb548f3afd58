// SPDX-License-Identifier: Apache-2.0
#include "tests/support/command.h"
#include "tests/support/paths.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace vitrail::test {

// Programs keep nothing for the next time, unless the command names another folder: none can be there.
[[maybe_unused]] static const int without_cache = ::setenv("XDG_CACHE_HOME", "/dev/null", 1);

CommandResult run(const std::string& command) {
  CommandResult result;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::string vitrail(const std::string& verb) { return "'" + bin_dir() + "/vitrail' " + verb; }

// Open MPI comes to these two by itself on one machine, after half of a rank's start.
std::string mpi_vitrail(const std::string& verb, int ranks) {
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
         "OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_pml=ob1 "
         "OMPI_MCA_btl=self,vader mpirun -np " +
         std::to_string(ranks) + " " + vitrail(verb);
}

nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

std::filesystem::path corpus() {
  const char* named = std::getenv("VITRAIL_CORPUS");
  const std::filesystem::path path = named ? named : project_file("../shared/corpus");
  return std::filesystem::exists(path / "INDEX.tsv") ? path : std::filesystem::path();
}

}  // namespace vitrail::test
