// SPDX-License-Identifier: Apache-2.0
#include "tests/support/background.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/support/command.h"

namespace vitrail::test {

using namespace std::chrono_literals;

namespace {

bool is_mpirun(pid_t process) {
  std::string name;
  return std::ifstream(fmt::format("/proc/{}/comm", process)) >> name && name == "mpirun";
}

}  // namespace

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

// Of Open MPI 4.1 with PMIx 4.2 one mpirun in twenty-five never ends when a rank of its was killed: its end
// waits for a lock in memory that it has freed.
int Background::wait() {
  for (int alone_s = 0; running(); ++alone_s) {
    for (int i = 0; i < 100 && running(); ++i) std::this_thread::sleep_for(10ms);
    if (!is_mpirun(pid_) || !ranks().empty()) alone_s = 0;
    if (alone_s >= 20) send(SIGKILL);
  }
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

bool Background::signalled() const { return ended_ && WIFSIGNALED(status_); }

std::vector<pid_t> Background::ranks() const {
  std::istringstream pids(
      run(fmt::format("pgrep -r D,R,S,T -g {} -f vitrail-render; pgrep -r D,R,S,T -P {}", pid_, pid_))
          .output);
  std::vector<pid_t> found;
  for (pid_t pid; pids >> pid;)
    if (pid != pid_ && std::ranges::find(found, pid) == found.end()) found.push_back(pid);
  return found;
}

}  // namespace vitrail::test
