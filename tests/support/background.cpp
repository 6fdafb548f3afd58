// SPDX-License-Identifier: Apache-2.0
#include "tests/support/background.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "tests/support/command.h"

namespace vitrail::test {

Background::Background(const std::string& command) : pid_(::fork()) {
  if (pid_ != 0) return;
  ::setpgid(0, 0);
  ::execl("/bin/sh", "sh", "-c", ("exec env " + command + " >/dev/null 2>&1").c_str(), nullptr);
  ::_exit(127);
}

Background::~Background() {
  if (!running()) return;
  send(SIGKILL);
  wait();
}

bool Background::running() {
  if (!ended_ && ::waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
  return !ended_;
}

void Background::send(int signal) const { ::kill(pid_, signal); }

int Background::wait() {
  if (!ended_) ::waitpid(pid_, &status_, 0);
  ended_ = true;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

bool Background::signalled() const { return ended_ && WIFSIGNALED(status_); }

std::vector<pid_t> Background::ranks() const {
  std::istringstream pids(run(fmt::format("pgrep -g {} -f vitrail-render; pgrep -P {}", pid_, pid_)).output);
  std::vector<pid_t> found;
  for (pid_t pid; pids >> pid;)
    if (pid != pid_ && std::ranges::find(found, pid) == found.end()) found.push_back(pid);
  return found;
}

}  // namespace vitrail::test
