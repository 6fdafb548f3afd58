// SPDX-License-Identifier: Apache-2.0
#include "scene/input_files.h"

#include <sys/stat.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

namespace vitrail {

namespace {

using Identity = std::pair<dev_t, ino_t>;

struct Inputs {
  std::atomic<bool> protect = false;
  std::mutex mutex;
  std::set<Identity> files;
};

Inputs& inputs() {
  static Inputs only;
  return only;
}

std::optional<Identity> identity_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return Identity{status.st_dev, status.st_ino};
}

}  // namespace

void protect_inputs() { inputs().protect = true; }

void note_input(const std::filesystem::path& file) {
  if (!inputs().protect) return;
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return;
  const std::lock_guard lock(inputs().mutex);
  inputs().files.insert(*identity);
}

bool is_input(const std::filesystem::path& file) {
  const std::optional<Identity> identity = identity_of(file);
  if (!identity) return false;
  const std::lock_guard lock(inputs().mutex);
  return inputs().files.contains(*identity);
}

}  // namespace vitrail
