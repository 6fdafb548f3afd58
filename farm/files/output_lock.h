// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "scene/system/diagnostics.h"

namespace vitrail {

// It says that another job writes that output.
struct BeingWritten : MachineError {
  BeingWritten(const std::string& message, std::string who, bool may_be_gone)
      : MachineError(message), holder(std::move(who)), is_only_named(may_be_gone) {}
  std::string holder;  // "process 12 on node7"
  bool is_only_named;  // the file system has no locks, and the process may have been killed
};

// Returns OUTPUT.lock, the file of its lock.
std::filesystem::path lock_path(std::filesystem::path output);

// It is held by the one job that may write a film: OUTPUT.lock beside it, which the system frees when the
// process ends, however it ends. Throws BeingWritten where another job has it, and says which. Where the file
// system has no locks, the process and host in that file are believed. Throws MachineError where there is no
// such folder.
class OutputLock {
 public:
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

// Takes the lock, and tries again for so long where another job has it, once `before_waiting` has been called
// with that refusal. A name that nobody can verify is not waited for.
std::unique_ptr<OutputLock> wait_for_lock(
    const std::filesystem::path& output, std::chrono::milliseconds longest,
    const std::function<void(const BeingWritten&)>& before_waiting = {});

// Returns whether a job has that lock, as far as this host can know. A process in the file that is of this
// host and has ended does not have it.
bool is_being_written(const std::filesystem::path& output);

// Returns the process that has it, where that is of this host and stopped (SIGSTOP, a debugger).
std::optional<int> stopped_writer(const std::filesystem::path& output);

}  // namespace vitrail
