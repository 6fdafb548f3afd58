// SPDX-License-Identifier: Apache-2.0
#include "cli/render/preview.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>

#include "cli/common/run_program.h"

namespace vitrail {

void Preview::finish() {
  if (developing_ > 0) ::waitpid(developing_, nullptr, 0);
  developing_ = 0;
}

bool Preview::busy() {
  if (developing_ > 0 && ::waitpid(developing_, nullptr, WNOHANG) == 0) return true;
  developing_ = 0;
  return false;
}

void Preview::develop(const std::filesystem::path& film) {
  if (busy()) return;
  std::array<std::string, 7> words{(program_folder() / "vitrail-develop").string(),
                                   film.string(),
                                   "-o",
                                   picture_.string(),
                                   "--quiet",
                                   "--exposure",
                                   "fit"};
  std::array<char*, 8> argv{};
  for (std::size_t i = 0; i < words.size(); ++i) argv[i] = words[i].data();
  if (::posix_spawn(&developing_, argv[0], nullptr, nullptr, argv.data(), environ) != 0) developing_ = 0;
}

}  // namespace vitrail
