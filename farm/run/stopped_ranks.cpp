// SPDX-License-Identifier: Apache-2.0
#include "farm/run/stopped_ranks.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace vitrail {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Whether it is a stopped child of `parent`. Behind its name, in parentheses, stand its state and its parent.
bool is_stopped_child(const fs::path& process, pid_t parent) {
  const std::string stat = text_of(process / "stat");
  const std::size_t end = stat.rfind(')');
  if (end == std::string::npos || end + 4 >= stat.size()) return false;
  const char state = stat[end + 2];
  return (state == 'T' || state == 't') && std::atoi(stat.c_str() + end + 4) == parent;
}

std::optional<int> rank_of(const fs::path& process) {
  const std::string variables = '\0' + text_of(process / "environ");
  for (const std::string_view name : {"OMPI_COMM_WORLD_RANK=", "PMIX_RANK=", "SLURM_PROCID="})
    if (const std::size_t at = variables.find('\0' + std::string(name)); at != std::string::npos)
      return std::atoi(variables.c_str() + at + 1 + name.size());
  return std::nullopt;
}

}  // namespace

std::vector<int> stopped_ranks_of_host() {
  std::vector<int> ranks;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator("/proc", unreadable)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (!is_stopped_child(entry.path(), ::getppid())) continue;
    if (const std::optional<int> rank = rank_of(entry.path())) ranks.push_back(*rank);
  }
  std::ranges::sort(ranks);
  return ranks;
}

}  // namespace vitrail
