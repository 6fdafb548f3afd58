// SPDX-License-Identifier: Apache-2.0
// This thread looks whether files of the bundle change while they are mapped. Nobody else may notice: a
// traversal of such a file may have no end, and a checkpoint waits for it.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace vitrail {

// It ends the process with status 3, and the file's name, where a watched file (bundle/watched_files.h) has
// changed. It looks once a second, or takes a hundredth of its time where there are many.
class FileWatch {
 public:
  // `who` is "rank 1 of 4: ", or nothing.
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
