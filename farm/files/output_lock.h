// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace vitrail {

// Held by the one job that may write a film: OUTPUT.lock beside it, which the system frees when the process
// ends, however it ends. Throws MachineError where another job has it, and says which. Where the file system
// has no locks, the process and host in that file are believed.
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

// Whether a job has that lock, as far as this host can know: not where the process in the file is of this
// host and has ended.
bool is_being_written(const std::filesystem::path& output);

// The process that has it, where that is of this host and stopped (SIGSTOP, a debugger).
std::optional<int> stopped_writer(const std::filesystem::path& output);

}  // namespace vitrail
