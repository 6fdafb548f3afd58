// SPDX-License-Identifier: Apache-2.0
#include "bundle/watched_files.h"

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>

#include "scene/system/diagnostics.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

// As it was when it was first mapped. Files form a list to which one is added at a time and from which none
// is taken: threads and signal handlers go through it without a lock.
struct Watched {
  std::string name;
  struct stat status;
  const Watched* older;
};

std::atomic<const Watched*> newest = nullptr;
static_assert(std::atomic<const Watched*>::is_always_lock_free);

struct Registry {
  std::mutex mutex;
  std::map<std::string_view, const Watched*> latest;  // of that name
};

Registry& registry() {
  static Registry only;
  return only;
}

bool same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool unchanged(const struct stat& a, const struct stat& b) {
  const auto content = [](const struct stat& s) {
    return std::tuple(s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec);
  };
  return content(a) == content(b);
}

bool has_changed(const Watched& w) {
  struct stat now;
  return ::stat(w.name.c_str(), &now) == 0 && same_file(w.status, now) && !unchanged(w.status, now);
}

}  // namespace

void watch(const std::filesystem::path& file, const struct stat& now) {
  const std::lock_guard lock(registry().mutex);
  const auto known = registry().latest.find(file.native());
  if (known != registry().latest.end() && same_file(known->second->status, now)) return;
  const auto* added = new Watched{file.native(), now, newest.load(std::memory_order_relaxed)};
  registry().latest.insert_or_assign(added->name, added);
  newest.store(added, std::memory_order_release);
}

const char* changed_file() {
  for (const Watched* w = newest.load(std::memory_order_acquire); w; w = w->older)
    if (has_changed(*w)) return w->name.c_str();
  return nullptr;
}

void require_unchanged_files() {
  for (const Watched* w = newest.load(std::memory_order_acquire); w; w = w->older) {
    const std::filesystem::path path = w->name;
    const Underway underway("looking at", path);
    if (has_changed(*w)) throw Error(file_changed, {w->name});
  }
}

}  // namespace vitrail
