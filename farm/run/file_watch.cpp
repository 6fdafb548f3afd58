// SPDX-License-Identifier: Apache-2.0
#include "farm/run/file_watch.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "bundle/watched_files.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {

FileWatch::FileWatch(std::string who) : who_(std::move(who)), thread_([this] { watch(); }) {}

FileWatch::~FileWatch() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FileWatch::watch() {
  constexpr int bad_input = 3;  // the exit status of that
  std::chrono::steady_clock::duration pause = std::chrono::seconds(1);
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, pause, [&] { return ended_; })) {
    lock.unlock();
    const std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    try {
      require_unchanged_files();
    } catch (const Error& e) {
      say("vitrail: {}{}: {}\n", who_, e.location.file, e.what());
      std::_Exit(bad_input);
    }
    pause = std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(1),
                                                          100 * (std::chrono::steady_clock::now() - begin));
    lock.lock();
  }
}

}  // namespace vitrail
