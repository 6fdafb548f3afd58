// SPDX-License-Identifier: Apache-2.0
#include "tests/support/background.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

namespace vitrail::test {

using namespace std::chrono_literals;

namespace {

bool is_mpirun(pid_t process) {
  std::string name;
  return std::ifstream(fmt::format("/proc/{}/comm", process)) >> name && name == "mpirun";
}

}  // namespace

std::string process_text(pid_t process, const char* name) {
  std::ostringstream text;
  text << std::ifstream(fmt::format("/proc/{}/{}", process, name)).rdbuf();  // iterators would throw
  return text.str();
}

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

// As `pgrep -g` and `pgrep -P`, which take ten times as long: tests ask every few milliseconds.
std::vector<pid_t> Background::ranks() const {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const auto pid = static_cast<pid_t>(std::atol(entry.path().filename().c_str()));
    if (pid <= 0 || pid == pid_) continue;
    const std::string stat = process_text(pid, "stat");  // pid (name) state parent group …
    const auto name_end = stat.rfind(')');
    if (name_end == std::string::npos) continue;
    char state = 0;
    pid_t parent = 0, group = 0;
    std::istringstream(stat.substr(name_end + 1)) >> state >> parent >> group;
    const bool lives = std::string_view("DRST").find(state) != std::string_view::npos;
    if (lives && (parent == pid_ || (group == pid_ && process_text(pid, "cmdline").find("vitrail-render") !=
                                                          std::string::npos)))
      found.push_back(pid);
  }
  return found;
}

}  // namespace vitrail::test
