// SPDX-License-Identifier: Apache-2.0
#include "farm/reserved_space.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "scene/diagnostics.h"
#include "scene/output_place.h"

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
  release();
  std::string name = beside_.string() + ".room-XXXXXX";
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) return false;
  ::unlink(name.c_str());
  if (::fallocate(descriptor_, 0, 0, static_cast<off_t>(bytes_)) == 0) return true;
  const int reason = errno;
  release();
  errno = reason;
  return reason == EOPNOTSUPP || reason == ENOSYS;
}

}  // namespace vitrail
