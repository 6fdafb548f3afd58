// SPDX-License-Identifier: Apache-2.0
// A thread that looks whether files of the bundle change while they are mapped. Nobody else may notice: what
// such a file makes of a traversal may have no end, and a checkpoint waits for it.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace vitrail {

// Ends the process with status 3, and the file's name, where a watched file (bundle/watched_files.h) has
// changed. It looks once a second, or takes a hundredth of its time where there are many.
class FileWatch {
 public:
  // `who`: "rank 1 of 4: ", or nothing.
  explicit FileWatch(std::string who);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

 private:
  void watch();

  std::string who_;
  std::mutex mutex_;  // of the next
  bool ended_ = false;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace vitrail
