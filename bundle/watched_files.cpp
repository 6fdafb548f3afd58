// SPDX-License-Identifier: Apache-2.0
#include "bundle/watched_files.h"

#include <sys/stat.h>

#include <map>
#include <mutex>
#include <string>
#include <tuple>

#include "scene/system/diagnostics.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

struct Watched {
  dev_t device;
  ino_t inode;
  off_t size;
  timespec modified;
};

struct Registry {
  std::mutex mutex;
  std::map<std::string, Watched> files;
};

Registry& registry() {
  static Registry only;
  return only;
}

Watched of(const struct stat& s) { return {s.st_dev, s.st_ino, s.st_size, s.st_mtim}; }

bool same_file(const Watched& a, const Watched& b) { return a.device == b.device && a.inode == b.inode; }

bool unchanged(const Watched& a, const Watched& b) {
  const auto content = [](const Watched& w) {
    return std::tuple(w.size, w.modified.tv_sec, w.modified.tv_nsec);
  };
  return content(a) == content(b);
}

}  // namespace

void watch(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return;  // who maps it says so
  const Watched now = of(status);
  const std::lock_guard lock(registry().mutex);
  const auto [at, is_new] = registry().files.try_emplace(file.string(), now);
  if (!is_new && !same_file(at->second, now)) at->second = now;
}

void require_unchanged_files() {
  const std::lock_guard lock(registry().mutex);
  for (const auto& [file, then] : registry().files) {
    const std::filesystem::path path = file;
    const Underway underway("looking at", path);
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) continue;
    if (same_file(then, of(status)) && !unchanged(then, of(status)))
      throw Error(
          "this file changed during the render: the samples after the last checkpoint may be wrong, and are "
          "not written",
          {file});
  }
}

}  // namespace vitrail
