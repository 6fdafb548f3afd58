// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace vitrail::test {

// The file /proc/PROCESS/NAME. Empty where the process has ended, also between the opening and the reading.
std::string process_text(pid_t process, const char* name);

// A command started in the background, in a process group of its own; nothing of its output is kept.
class Background {
 public:
  explicit Background(const std::string& command);
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  bool running();
  void send(int signal) const;  // to the command alone
  int wait();                   // exit status; 128 + signal where one ended it
  bool signalled() const;       // once it has ended: by a signal
  pid_t pid() const { return pid_; }
  // The render processes below it that live.
  std::vector<pid_t> ranks() const;

 private:
  pid_t pid_;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace vitrail::test
