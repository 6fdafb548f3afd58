// SPDX-License-Identifier: Apache-2.0
// Each thread notes the steps that it has begun and not ended: a watcher sees which thread stands still, and
// at which file. A disk that does not answer holds a thread inside one call, where nothing else can tell.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vitrail {

// This thread does one thing until the end of the scope, such as "reading" and the file. These scopes nest;
// the innermost is named. One takes some 50 ns.
class Underway {
 public:
  // `what` and `file` outlive it.
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

// Returns the thread that has stood still longest, of those that do so for `at_least_s`; one that stands at a
// file goes before the others, which may wait for it. A thread goes on when it takes time of the processor,
// begins or ends something: with a slow disk it does, step by step. One watcher calls this again and again,
// `since_last_s` apart.
std::optional<Standstill> longest_standstill(double since_last_s, double at_least_s);

}  // namespace vitrail
