// SPDX-License-Identifier: Apache-2.0
#include "farm/files/reserved_space.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "scene/system/diagnostics.h"
#include "scene/system/output_place.h"
#include "scene/system/scratch_file.h"
#include "scene/system/underway.h"

namespace vitrail {

ReservedSpace::ReservedSpace(std::filesystem::path beside, std::uint64_t bytes)
    : beside_(std::move(beside)), bytes_(bytes) {
  require_room(beside_, bytes_);
  if (!renew())
    throw MachineError(fmt::format("cannot reserve {} MB for {}: {}", bytes_ / 1'000'000 + 1,
                                   beside_.string(), std::strerror(errno)));
}

ReservedSpace::~ReservedSpace() { release(); }

void ReservedSpace::release() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

// The reason stays in errno.
bool ReservedSpace::renew() {
  const Underway underway("reserving room for", beside_);
  release();
  const std::filesystem::path folder = beside_.parent_path();
  descriptor_ = open_nameless_file(folder.empty() ? "." : folder);
  if (descriptor_ < 0) return false;
  if (::fallocate(descriptor_, 0, 0, static_cast<off_t>(bytes_)) == 0) return true;
  const int reason = errno;
  release();
  errno = reason;
  return reason == EOPNOTSUPP || reason == ENOSYS;
}

double ReservedSpace::time_to_write_s() const {
  constexpr std::size_t most_tried = 8 << 20;
  constexpr double slow_disk_s_per_byte = 1e-8;
  const Underway underway("trying the disk of", beside_);
  const auto all = static_cast<double>(bytes_);
  if (descriptor_ < 0) return slow_disk_s_per_byte * all;
  // Nothing that a file system could pack.
  std::vector<std::uint64_t> words(std::min<std::size_t>(most_tried, bytes_) / sizeof(std::uint64_t) + 1);
  for (std::uint64_t word = 1; std::uint64_t & w : words) w = word = word * 6364136223846793005u + 1;
  const std::size_t bytes = std::min<std::size_t>(words.size() * sizeof(std::uint64_t), bytes_);
  double least_s =
      std::numeric_limits<double>::infinity();  // what else is on its way to the disk is not of it
  for (int i = 0; i < 2; ++i) {
    const auto start = std::chrono::steady_clock::now();
    if (::pwrite(descriptor_, words.data(), bytes, 0) != static_cast<ssize_t>(bytes) ||
        ::fdatasync(descriptor_) != 0)
      return slow_disk_s_per_byte * all;
    least_s =
        std::min(least_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least_s * all / static_cast<double>(bytes);
}

}  // namespace vitrail
