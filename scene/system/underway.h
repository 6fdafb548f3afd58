// SPDX-License-Identifier: Apache-2.0
// What the threads of this process have begun and not ended: who watches them sees which one stands still,
// and at which file. A disk that does not answer holds a thread inside one call, where nothing else can tell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vitrail {

// From here to the end of the scope this thread does one thing: "reading", and the file. They nest; the
// innermost is named. Some 50 ns.
class Underway {
 public:
  // Both outlive it.
  explicit Underway(const char* what) : Underway(what, nullptr) {}
  Underway(const char* what, const std::filesystem::path& file) : Underway(what, &file) {}
  Underway(const char* what, std::filesystem::path&& file) = delete;
  ~Underway();
  Underway(const Underway&) = delete;
  Underway& operator=(const Underway&) = delete;

 private:
  Underway(const char* what, const std::filesystem::path* file);
};

struct Standstill {
  std::string what;  // "reading /scene.vit/manifest.json"
  double seconds = 0;
  bool at_file = false;
};

// Of the threads that stand still for `at_least_s` the one that does for longest; one at a file before those
// that may wait for it. A thread goes on when it takes time of the processor, begins or ends something: with
// a slow disk it does, step by step. One watcher calls this again and again, `since_last_s` apart.
std::optional<Standstill> longest_standstill(double since_last_s, double at_least_s);

}  // namespace vitrail
